// A text table of measured motion, as spreadsheets, trackers and loggers write it: comma, semicolon,
// tab or blanks between, decimal point or comma, a header or none, empty cells at the ends.

import { Refused } from "../words/refused";

/** Numbers by columns; NaN where a cell is empty. */
export interface Table {
  /** As the header names them, or "column 1", …; empty where there is no header. */
  names: string[];
  columns: Float64Array[];
  /** Line of the file [from 1] of each row. */
  lines: number[];
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
const DECIMAL_COMMA = /^[+-]?\d*,\d+([eE][+-]?\d+)?$/;
const MOST_BYTES = 64e6;

/** The text of a file: UTF-8 or, with its mark, UTF-16; what is neither is read as Latin-1. */
export function decoded(bytes: Uint8Array): string {
  if (bytes.length > MOST_BYTES) throw new Refused("data_too_large");
  const wide = bytes[0] === 0xff && bytes[1] === 0xfe ? "utf-16le" : "utf-16be";
  if ((bytes[0] === 0xff && bytes[1] === 0xfe) || (bytes[0] === 0xfe && bytes[1] === 0xff)) {
    return new TextDecoder(wide).decode(bytes);
  }
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("latin1").decode(bytes);
  }
}

/** What a table of text holds; throws `Refused`, with the number of the line, where it is none. */
export function tableOf(text: string): Table {
  if (text.includes("\0")) throw new Refused("data_no_text");
  const lines = text.split(/\r\n|\n|\r/);
  const used = lines
    .map((line, i) => ({ line, number: i + 1 }))
    .filter(({ line }) => line.trim() !== "" && !line.startsWith("#"));
  if (used.length < 2) throw new Refused("data_empty");
  const separator = separatorOf(used.map(({ line }) => line));
  const rows = used.map(({ line, number }) => ({ cells: cellsOf(line, separator), number }));
  const first = rows.findIndex(({ cells }) => numeric(cells, separator));
  if (first < 0 || first > 5) {
    const row = rows[Math.min(1, rows.length - 1)];
    throw new Refused("data_no_numbers", { line: row.number, cell: row.cells[0] });
  }
  const width = rows[first].cells.length;
  const names =
    first > 0
      ? headings(
          rows.slice(0, first).map((row) => row.cells),
          width,
        )
      : [];
  return { names, ...numbersOf(rows.slice(first), width, separator) };
}

function separatorOf(lines: string[]): string {
  const sample = lines.slice(0, 20);
  const often = (mark: string) => sample.every((line) => line.includes(mark));
  if (often("\t")) return "\t";
  if (often(";")) return ";";
  // "0,1 2,5": blanks between numbers with a decimal comma
  const body = sample.slice(1);
  const blanks = body.every((line) =>
    line
      .trim()
      .split(/\s+/)
      .every((cell) => DECIMAL_COMMA.test(cell)),
  );
  if (often(",") && !(blanks && body.length > 0)) return ",";
  return " ";
}

function cellsOf(line: string, separator: string): string[] {
  const parts = separator === " " ? line.trim().split(/\s+/) : quotedCells(line, separator);
  const cells = parts.map((cell) => cell.trim());
  while (cells.length > 1 && cells[cells.length - 1] === "") cells.pop();
  return cells;
}

function quotedCells(line: string, separator: string): string[] {
  if (!line.includes('"')) return line.split(separator);
  const pattern = new RegExp(`(?:^|${separator})(?:"((?:[^"]|"")*)"|([^${separator}]*))`, "g");
  return [...line.matchAll(pattern)].map((found) => found[1]?.replaceAll('""', '"') ?? found[2]);
}

function numeric(cells: string[], separator: string): boolean {
  const filled = cells.filter((cell) => cell !== "");
  return filled.length > 0 && filled.every((cell) => !Number.isNaN(numberOf(cell, separator)));
}

/** A cell's number; NaN: it is none. */
function numberOf(cell: string, separator: string): number {
  const plain = separator !== "," && DECIMAL_COMMA.test(cell) ? cell.replace(",", ".") : cell;
  return NUMBER.test(plain) ? Number(plain) : Number.NaN;
}

/** Names from the lines above the numbers; a second line, of units, is added to them. */
function headings(rows: string[][], width: number): string[] {
  return Array.from({ length: width }, (_, i) =>
    rows
      .map((cells) => cells[i] ?? "")
      .filter((cell) => cell !== "")
      .join(" "),
  );
}

function numbersOf(
  rows: { cells: string[]; number: number }[],
  width: number,
  separator: string,
): Pick<Table, "columns" | "lines"> {
  const columns = Array.from({ length: width }, () =>
    new Float64Array(rows.length).fill(Number.NaN),
  );
  rows.forEach(({ cells, number }, row) => {
    if (cells.length > width) {
      throw new Refused("data_width", { line: number, count: cells.length, width });
    }
    cells.forEach((cell, column) => {
      if (cell === "") return;
      const value = numberOf(cell, separator);
      if (Number.isNaN(value)) {
        throw new Refused("data_cell", { line: number, column: column + 1, cell });
      }
      columns[column][row] = value;
    });
  });
  return { columns, lines: rows.map((row) => row.number) };
}
