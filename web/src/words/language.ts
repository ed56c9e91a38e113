// The page's language: sentences, numbers and dates in it.

import { type Key, type Values, words } from "./words";

export type Language = "en" | "es";

let language: Language = "en";

/** The language of the page. */
export const current = (): Language => language;

/** Sets it, for the document too. */
export function speak(next: Language): void {
  language = next;
  document.documentElement.lang = next;
}

/** The browser's, where the address names none. */
export function preferred(): Language {
  return navigator.languages.some((each) => each.startsWith("es")) &&
    !navigator.language.startsWith("en")
    ? "es"
    : "en";
}

/** A sentence; what it names in braces is filled in. */
export function t(key: Key, values: Values = {}): string {
  const template = words[key][language === "en" ? 0 : 1];
  return template.replace(/\{(\w+)\}/g, (_, name: string) => {
    const value = values[name];
    return typeof value === "number" ? shown(value, 6) : String(value ?? "");
  });
}

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** A number with so many digits at most, in the language's way. */
export function shown(value: number, digits = 4): string {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return powerOfTen(value);
  return local(String(Number(value.toPrecision(digits))));
}

/** A number with so many decimals. */
export function fixed(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return shown(value);
  const text = value.toFixed(decimals);
  return local(/^-0(\.0*)?$/.test(text) ? text.slice(1) : text);
}

/** As 3.2 · 10⁻⁹. */
export function powerOfTen(value: number, digits = 2): string {
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const plain = mantissa.replace(/\.?0+$/, "");
  const power = superscript(Number(exponent));
  return plain === "1" ? `10${power}` : `${local(plain)} · 10${power}`;
}

/** An exponent, raised. */
export function superscript(value: number): string {
  const digits = String(Math.abs(value)).replace(/\d/g, (digit) => SUPERSCRIPTS[Number(digit)]);
  return (value < 0 ? "⁻" : "") + digits;
}

function local(text: string): string {
  const signed = text.replace("-", "−");
  return language === "es" ? signed.replace(".", ",") : signed;
}

/** A typed number, with decimal point or comma; NaN: it is none. */
export function parseNumber(text: string): number {
  const plain = text.trim().replace(/[−–]/, "-").replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : Number.NaN;
}
