// A number with its unit: typed, with decimal point or comma, or moved by a slider. Typed values may
// lie outside the slider; one that breaks a rule is not taken, and a line below says why.

import { parseNumber, shown, t } from "../words/language";
import { Refused } from "../words/refused";
import { el, fresh } from "./dom";

/** What a field is for. */
export interface NumberOptions {
  label: string;
  symbol?: string;
  unit: string;
  slider: readonly [number, number];
  /** Takes the value; throws `Refused` where it breaks a rule. */
  take: (value: number) => void;
  meaning?: string;
}

/** A field, and how it shows a value that comes from elsewhere. */
export interface NumberField {
  element: HTMLElement;
  show: (value: number) => void;
}

const PARTS = 200; // places of a slider

/** A slider and a box to type in. */
export function numberField(options: NumberOptions): NumberField {
  const { label, unit, take } = options;
  const [low, high] = options.slider;
  const box = fresh("number");
  const said = fresh("said");
  const typed = el("input", { id: box, type: "text", inputmode: "decimal", autocomplete: "off" });
  const name = unit ? `${label} (${unit})` : label;
  const slider = el("input", { type: "range", min: low, max: high, "aria-label": name });
  slider.step = String((high - low) / PARTS);
  const wrong = el("p", { id: said, class: "wrong", role: "alert" });
  let value = Number.NaN;

  const show = (next: number) => {
    value = next;
    if (document.activeElement !== typed) typed.value = shown(next, 6);
    slider.value = String(next);
    slider.setAttribute("aria-valuetext", `${shown(next, 6)} ${unit}`);
    tell("");
  };
  const tell = (line: string) => {
    if (wrong.textContent !== line) wrong.textContent = line;
    typed.toggleAttribute("aria-invalid", line !== "");
    if (line) {
      typed.setAttribute("aria-invalid", "true");
      typed.setAttribute("aria-describedby", said);
    } else typed.removeAttribute("aria-describedby");
  };
  const give = (next: number, source: string) => {
    try {
      if (Number.isNaN(next)) throw new Refused("rule_number", { key: label, value: source });
      take(next);
      tell("");
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      tell(t(error.key, { ...error.values, key: label }));
    }
  };
  slider.addEventListener("input", () => give(Number(slider.value), slider.value));
  typed.addEventListener("change", () => give(parseNumber(typed.value), typed.value));
  typed.addEventListener("blur", () => {
    if (wrong.textContent === "") typed.value = shown(value, 6);
  });
  const text = options.symbol
    ? [el("i", { class: "symbol" }, options.symbol), el("span", {}, ` ${label}`)]
    : [el("span", {}, label)];
  const head = el("label", { for: box, title: options.meaning ?? "" }, ...text);
  const units = el("span", { class: "unit", "aria-hidden": "true" }, unit);
  const element = el("div", { class: "number" }, head, slider, typed, units, wrong);
  return { element, show };
}
