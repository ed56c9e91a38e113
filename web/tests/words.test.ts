// Both languages have every sentence, with the same values in it; and each sentence is used.

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { catalogue } from "../src/core/catalogue";
import { fixed, parseNumber, powerOfTen, shown, speak } from "../src/words/language";
import { type Key, words } from "../src/words/words";

const keys = Object.keys(words) as Key[];
const places = (text: string) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort();

test.each(keys)("%s", (key) => {
  const [english, spanish] = words[key];
  expect(english).not.toBe("");
  expect(spanish).not.toBe("");
  expect(places(spanish)).toStrictEqual(places(english));
});

function sources(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return sources(path);
    return path.endsWith(".ts") && !path.includes("/words/") ? [readFileSync(path, "utf8")] : [];
  });
}

test("no sentence is left over", () => {
  const folder = new URL("../src", import.meta.url).pathname;
  const code = sources(folder).join("\n") + readFileSync(`${folder}/words/catalogue.ts`, "utf8");
  const unused = keys.filter((key) => !code.includes(`"${key}"`) && !/^why_/.test(key));
  expect(unused).toStrictEqual([]);
});

test("every phrase of the catalogue has its Spanish", () => {
  const spanish = readFileSync(new URL("../../docs/words.toml", import.meta.url), "utf8");
  const phrases = catalogue.systems.flatMap((system) => [
    ...system.components.map((row) => row.meaning),
    ...system.forms.flatMap((form) => [form.meaning, ...form.parameters.map((row) => row.meaning)]),
  ]);
  const lacking = phrases.filter((phrase) => !spanish.includes(`"${phrase}" = `));
  expect(lacking).toStrictEqual([]);
});

test("numbers as each language writes them", () => {
  const document = { documentElement: { lang: "" } };
  Object.assign(globalThis, { document });
  speak("es");
  expect([shown(-1.5), fixed(2, 2), powerOfTen(3.2e-9)]).toStrictEqual([
    "−1,5",
    "2,00",
    "3,2 · 10⁻⁹",
  ]);
  speak("en");
  expect([shown(0.1 + 0.2, 3), fixed(-0.001, 1), shown(1e300)]).toStrictEqual([
    "0.3",
    "0.0",
    "10³⁰⁰",
  ]);
});

test("typed numbers take both decimal signs, and nothing else", () => {
  expect(["1,5", " −2.5e-3 ", ".5", "7"].map(parseNumber)).toStrictEqual([1.5, -0.0025, 0.5, 7]);
  expect(
    ["", "1,5,0", "0x10", "1 2", "inf", "1e"].every((text) => Number.isNaN(parseNumber(text))),
  ).toBe(true);
});
