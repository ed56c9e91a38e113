// What the colours of the flip map mean.

import { el } from "../controls/dom";
import { fixed, t } from "../words/language";
import { CHAOTIC, colourAt, REGULAR, SHADES, SOONEST } from "./colours";
import { FORBIDDEN, NEVER, type Quantity, UNRESOLVED } from "./level";

/** The scale of what is shown, up to `until` [s], and the colours of what has no value. */
export function legend(quantity: Quantity, until: number): HTMLElement {
  const bar = el("canvas", { width: 150, height: 1, "aria-hidden": "true" });
  const context = bar.getContext("2d")!;
  for (let x = 0; x < 150; ++x) {
    const part = quantity === "megno" ? 1 - x / 149 : x / 149;
    context.fillStyle = `rgb(${colourAt(part).join(" ")})`;
    context.fillRect(x, 0, 1, 1);
  }
  const scale = (low: string, high: string) => el("span", { class: "bar" }, low, bar, high);
  const entry = (kind: number, text: string) => {
    const key = el("span", { class: "key" }, text);
    key.style.setProperty("--shade", `rgb(${SHADES[kind].join(" ")})`);
    return key;
  };
  if (quantity === "megno") {
    const ends = [`${REGULAR} ${t("regular")}`, `${CHAOTIC} ${t("chaotic")}`] as const;
    return el("div", { class: "legend" }, scale(...ends));
  }
  return el(
    "div",
    { class: "legend" },
    scale(`${fixed(SOONEST, 1)} s`, `${until} s`),
    entry(NEVER, t("map_never", { time: until })),
    entry(FORBIDDEN, t("map_forbidden")),
    entry(UNRESOLVED, t("map_unresolved")),
  );
}
