// Tables of measured motion: made by hand here, and the recordings of real pendulums where they are.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { checkText } from "../src/measured/formats";
import { guess, seriesOf, startOf } from "../src/measured/series";
import { decoded, tableOf } from "../src/measured/table";
import { t } from "../src/words/language";
import { Refused } from "../src/words/refused";

function refusal(text: string): Refused {
  try {
    const table = tableOf(text);
    seriesOf(table, guess(table));
  } catch (error) {
    if (error instanceof Refused) return error;
    throw error;
  }
  throw new Error("was taken");
}

function read(text: string) {
  const table = tableOf(text);
  const reading = guess(table);
  return { table, reading, series: seriesOf(table, reading) };
}

describe("good tables", () => {
  test.each([
    ["t,theta_rad\n0,0.5\n0.1,0.4\n", "rad", 0.5],
    ["t;ángulo (°)\n0,0;30,5\n0,1;29,5\n", "deg", (30.5 * Math.PI) / 180],
    ["0\t0.5\n0.1\t0.4\n", "rad", 0.5],
    ["0,00 0,5\n0,10 0,4\n", "rad", 0.5],
    ["\ufefft;theta\n1;45\n2;44\n", "deg", Math.PI / 4],
    ["0, -18.9427\r\n0.03, -18.9\r\n", "deg", (-18.9427 * Math.PI) / 180],
    ['"Time (s)","Angle (rad)"\n"0","5e-1"\n1,4e-1\n', "rad", 0.5],
    ["# a note\nt,theta\n(s),(rad)\n0,.5\n1,.4\n", "rad", 0.5],
  ])("%j", (text, unit, first) => {
    const { reading, series } = read(text.replace(/^\ufeff/, ""));
    expect(reading.unit).toBe(unit);
    expect(series.theta[0]).toBeCloseTo(first, 12);
    expect(series.t[0]).toBe(0);
  });

  test("UTF-8, UTF-16 with its mark, Latin-1", () => {
    const text = "t;ángulo\n0;1\n1;2\n";
    const latin = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    const wide = new Uint8Array([0xff, 0xfe, ...[...text].flatMap((l) => [l.charCodeAt(0), 0])]);
    for (const bytes of [new TextEncoder().encode(text), wide, latin]) {
      expect(decoded(bytes)).toBe(text);
    }
  });

  test("rows with empty cells are left out; the start is the first angle and its rate", () => {
    const { series } = read("t,theta\n0,0.5\n0.1,\n0.2,0.3\n");
    expect([...series.t]).toStrictEqual([0, 0.2]);
    expect(startOf(series)).toStrictEqual([0.5, -1]);
  });
});

describe("files that are no text tables are Python's to read", () => {
  const line = (name: string, ...bytes: number[]) => {
    try {
      checkText(name, Uint8Array.from(bytes));
    } catch (error) {
      if (error instanceof Refused) return t(error.key, error.values);
    }
    return "";
  };

  test.each(["mat", "xls", "xlsx", "ods", "trk", "trz", "zip", "parquet", "nc"])(
    ".%s",
    (ending) => {
      expect(line(`swing.${ending.toUpperCase()}`, 116)).toBe(
        `The page reads text tables alone; read this one in Python: pendula fit swing.${ending.toUpperCase()}`,
      );
    },
  );

  const formats: [string, ...number[]][] = [
    ["an archive or spreadsheet", 0x50, 0x4b, 3, 4],
    ["an old spreadsheet", 0xd0, 0xcf, 0x11, 0xe0],
    ["HDF5", 0x89, 0x48, 0x44, 0x46],
    ["NetCDF", 0x43, 0x44, 0x46, 1],
    ["Parquet", 0x50, 0x41, 0x52, 0x31],
    ["XML", 0x3c, 0x3f, 0x78, 0x6d, 0x6c],
  ];
  test.each(formats)("%s by what is in it", (_, ...bytes) => {
    expect(line("the swing's.csv", ...bytes)).toMatch(/: pendula fit 'the swing'\\''s\.csv'$/);
  });

  test("a text table is read", () => {
    expect(line("swing.csv", 116, 44, 120)).toBe("");
    expect(line("swing.nc.txt", 116)).toBe("");
  });
});

describe("bad tables get one line, with the number of the line", () => {
  test.each([
    ["", "data_empty", undefined],
    ["a\u0000b\n", "data_no_text", undefined],
    ["t,theta\n", "data_empty", undefined],
    ["t,theta\n0,0.5\n0.1,abc\n", "data_cell", 3],
    ["t,theta\n0,0.5\n0.1,0.4,3\n", "data_width", 3],
    ["t,theta\n0,0.5\n0.1,0.4\n0.05,0.3\n", "data_backwards", 4],
    ["t,mass\n0,0.5\n0.1,0.4\n", "data_no_angle", undefined],
    ["theta\n0.5\n0.4\n", "data_one_column", undefined],
    ["Lorem ipsum\ndolor sit\namet\n", "data_no_numbers", 2],
  ])("%j", (text, key, line) => {
    const refused = refusal(text);
    expect(refused.key).toBe(key);
    expect(refused.values.line).toBe(line);
  });
});

// Recordings are no part of the project: they lie beside it, or where the variable says.
const root = new URL("../..", import.meta.url).pathname;
const recordings = [
  process.env.PENDULA_RECORDINGS ?? "",
  join(root, "../shared/data"),
  join(root, "../../shared/data"),
].find((folder) => folder !== "" && existsSync(folder));

describe.skipIf(!recordings)("recordings of real pendulums", () => {
  test.each([
    ["single_pendulum_freeswing_1kHz.csv", "rad", true, 55],
    ["single_small_swing_encoder.csv", "rad", true, 0],
    ["single_three_runs_semicolon_degrees.csv", "deg", false, 0],
    ["single_no_header_degrees.csv", "deg", false, 20],
    ["double_tracked_degrees.csv", "deg", false, 0],
  ])("%s", (name, unit, upright, span) => {
    const { reading, series } = read(decoded(readFileSync(join(recordings!, name))));
    expect([reading.unit, reading.upright]).toStrictEqual([unit, upright]);
    const end = series.t[series.t.length - 1];
    expect(end).toBeGreaterThan(0.95 * span);
    expect(Math.max(...series.theta.map(Math.abs))).toBeLessThan(
      name.startsWith("double") ? 30 : 4,
    );
  });

  test.each([
    "phone_linear_acceleration.csv",
    "double_encoder_1kHz_windows.mat",
    "phyphox_single.xls",
  ])("%s has no angle", (name) => {
    expect(() => read(decoded(readFileSync(join(recordings!, name))))).toThrow(Refused);
  });
});
