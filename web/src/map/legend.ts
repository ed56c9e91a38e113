// What the colours of the flip map mean.

import { el } from "../controls/dom";
import { fixed, t } from "../words/language";
import { colourOf, SHADES, SOONEST } from "./colours";
import { FORBIDDEN, NEVER, UNRESOLVED } from "./explorer";

/** The scale of times up to `until` [s], and the colours of what has none. */
export function legend(until: number): HTMLElement {
  const bar = el("canvas", { width: 150, height: 1, "aria-hidden": "true" });
  const context = bar.getContext("2d")!;
  for (let x = 0; x < 150; ++x) {
    const time = SOONEST * (until / SOONEST) ** (x / 149);
    context.fillStyle = `rgb(${colourOf(time, until).join(" ")})`;
    context.fillRect(x, 0, 1, 1);
  }
  const entry = (kind: number, text: string) => {
    const key = el("span", { class: "key" }, text);
    key.style.setProperty("--shade", `rgb(${SHADES[kind].join(" ")})`);
    return key;
  };
  return el(
    "div",
    { class: "legend" },
    el("span", { class: "bar" }, `${fixed(SOONEST, 1)} s`, bar, `${until} s`),
    entry(NEVER, t("map_never", { time: until })),
    entry(FORBIDDEN, t("map_forbidden")),
    entry(UNRESOLVED, t("map_unresolved")),
  );
}
