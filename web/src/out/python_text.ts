// Numbers and data as Python writes them: pendula's checksums are over that text.

/** A double as Python's repr gives it: the shortest digits that give its bits back. */
export function repr(value: number): string {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  if (value === 0) return Object.is(value, -0) ? "-0.0" : "0.0";
  const [, sign, first, rest, power] = /^(-?)(\d)(?:\.(\d+))?e([+-]\d+)$/.exec(
    value.toExponential(),
  ) as unknown as [string, string, string, string | undefined, string];
  const digits = first + (rest ?? "");
  const exponent = Number(power);
  // Python changes to an exponent below 1e-4 and from 1e16 on (float_repr_style "short").
  if (exponent < -4 || exponent >= 16) {
    const size = String(Math.abs(exponent)).padStart(2, "0");
    return `${sign}${first}${rest ? `.${rest}` : ""}e${exponent < 0 ? "-" : "+"}${size}`;
  }
  if (exponent < 0) return `${sign}0.${"0".repeat(-exponent - 1)}${digits}`;
  const whole = digits.slice(0, exponent + 1).padEnd(exponent + 1, "0");
  return `${sign}${whole}.${digits.slice(exponent + 1) || "0"}`;
}

/** A whole number, written without a point: counts of steps. */
export class Whole {
  constructor(readonly value: number) {}
}

export type Data =
  | null
  | boolean
  | number
  | string
  | Whole
  | readonly Data[]
  | { readonly [key: string]: Data };

/** JSON as Python's json.dumps writes it: floats by repr, ", " and ": " between, ASCII only. */
export function dumps(data: Data): string {
  if (data === null) return "null";
  if (typeof data === "boolean") return data ? "true" : "false";
  if (typeof data === "number") return repr(data);
  if (data instanceof Whole) return String(data.value);
  if (typeof data === "string") return quoted(data);
  if (Array.isArray(data)) return `[${data.map(dumps).join(", ")}]`;
  const entries = Object.entries(data as { readonly [key: string]: Data });
  return `{${entries.map(([key, value]) => `${quoted(key)}: ${dumps(value)}`).join(", ")}}`;
}

function quoted(text: string): string {
  return JSON.stringify(text).replace(
    /[\u007f-\uffff]/g,
    (letter) => `\\u${letter.charCodeAt(0).toString(16).padStart(4, "0")}`,
  );
}
