/** Sentences of faults: one line that names argument, rule, value and way out, as Python's `_messages` makes it. */
import type { Fault, FaultValue } from "./api";
import { catalogue } from "./catalogue";

export type Language = "en" | "es";

/** How a page calls arguments, and shows that one is given a value. */
export interface Naming {
  argument(name: string): string;
  given(name: string, value: string): string;
}

/** The names of the catalogue, as Python shows them. */
export const plainNames: Naming = {
  argument: (name) => name,
  given: (name, value) => `${name}=${value}`,
};

const places = /<([\w{}]+)(?:=([^<>]*))?>|\{(\w+)\}/g;

/** What is wrong, after the argument's name, and the way out after a semicolon. */
export function sentence(fault: Fault, language: Language, naming: Naming = plainNames): string {
  const row = catalogue.rules[fault.rule];
  if (!row) return `${naming.argument(fault.argument)}: ${fault.rule}`;
  const [rule, wayOut] =
    language === "es"
      ? [row.spanish, row.way_out_in_spanish]
      : [row.english, row.way_out_in_english];
  const details: Record<string, FaultValue> = { ...fault.details, value: fault.value };
  const inUnit = details.unit ? ` [${details.unit}]` : "";
  const detail = (name: string) => shown(name, details[name] ?? null, language);
  const filled = (wayOut ? `${rule}; ${wayOut}` : rule).replace(
    places,
    (whole, argument?: string, given?: string, name?: string) => {
      if (name === "in_unit") return inUnit;
      if (name) return name in details ? detail(name) : whole;
      const [named, value] = [argument ?? "", given].map((text) =>
        text?.replace(/\{(\w+)\}/g, (_, inner: string) => detail(inner)),
      );
      if (named === "call") return value ?? "";
      if (value === undefined) return naming.argument(named ?? "");
      return naming.given(named ?? "", value);
    },
  );
  return `${naming.argument(fault.argument)} ${filled}`;
}

function shown(name: string, value: FaultValue, language: Language): string {
  if (value === null) return "";
  if (typeof value === "number") return numberIn(value, language);
  if (typeof value === "string") return value;
  const or = language === "es" ? " o " : " or ";
  return value.join(name === "any_of" ? or : ", ");
}

/** With the few digits that a sentence needs where they are not the given ones, and the language's decimal sign. */
function numberIn(value: number, language: Language): string {
  const text = String(value);
  return language === "es" ? text.replace(".", ",") : text;
}
