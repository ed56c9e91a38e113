// Gravity of other worlds, and of one that nobody names: it is found with the period timer and the
// ruler.

import type { Lab } from "../run/lab";
import { parseNumber, shown, t } from "../words/language";
import type { Key } from "../words/words";
import { choice, el, fresh } from "./dom";

// Means at the surface, or at one bar [m/s²]: NASA's planetary fact sheets (Williams, 2024).
const WORLDS: readonly (readonly [Key, number])[] = [
  ["earth", 9.80665],
  ["moon", 1.62],
  ["mars", 3.73],
  ["venus", 8.87],
  ["jupiter", 24.79],
  ["titan", 1.35],
];
const UNKNOWN = "unknown";

/** The choice of a world, and the riddle. */
export function worlds(lab: Lab): HTMLElement {
  const gravity = lab.recipe.parameters.gravity;
  const known = WORLDS.find(([, value]) => value === gravity);
  const chosen = lab.hidden ? UNKNOWN : known ? known[0] : "";
  const options = [
    ...(chosen === "" ? [["", "–"] as const] : []),
    ...WORLDS.map(([key]) => [key, t(key)] as const),
    [UNKNOWN, t("planet_unknown")] as const,
  ];
  const element = el("div", { class: "worlds" });
  element.append(
    choice(t("world"), options, chosen, (key) => {
      lab.hidden = key === UNKNOWN;
      const value = WORLDS.find(([name]) => name === key)?.[1] ?? riddle();
      lab.change({ parameters: { ...lab.recipe.parameters, gravity: value } });
    }),
  );
  if (lab.hidden) element.append(guessing(lab));
  return element;
}

/** A gravity that no world above has [m/s²]. */
function riddle(): number {
  return Math.round(10 * (2 + 18 * Math.random())) / 10;
}

function guessing(lab: Lab): HTMLElement {
  const id = fresh("guess");
  const typed = el("input", { id, type: "text", inputmode: "decimal", autocomplete: "off" });
  const said = el("p", { class: "note", role: "status" });
  const guess = () => {
    const value = parseNumber(typed.value);
    const gravity = lab.recipe.parameters.gravity;
    if (Number.isNaN(value)) return;
    const off = Math.abs(value / gravity - 1);
    said.textContent =
      off < 0.02
        ? t("guess_right", { gravity })
        : t(value > gravity ? "guess_high" : "guess_low", { percent: shown(off * 100, 1) });
  };
  return el(
    "div",
    { class: "guess" },
    el("label", { for: id }, t("guess")),
    typed,
    el("button", { type: "button", onclick: guess }, t("check")),
    said,
  );
}
