// Play, pause, step, back to the start, time back and forth, speed.

import type { Lab } from "../run/lab";
import { fixed, shown, t } from "../words/language";
import type { Key } from "../words/words";
import { choice, el } from "./dom";
import { icon } from "./icons";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 30];

/** The controls of the clock, and how they follow it. */
export interface Transport {
  element: HTMLElement;
  follow: () => void;
  toggle: () => void;
  step: (places: number) => void;
}

/** A round button with a drawing. */
export function button(
  name: Key,
  drawing: string,
  onclick: () => void,
  extra = "",
): HTMLButtonElement {
  const label = t(name);
  return el(
    "button",
    { type: "button", class: `round ${extra}`, "aria-label": label, title: label, onclick },
    icon(drawing),
  );
}

export function transport(lab: Lab): Transport {
  const { clock } = lab;
  const step = (places: number) => {
    clock.pause();
    clock.go(clock.place + places);
    lab.tell("time");
  };
  const frame = () => Math.max(1, Math.round(1 / 60 / Math.abs(clock.spacing)));
  const toggle = () => {
    if (clock.playing) clock.pause();
    else clock.play();
    lab.tell("time");
  };
  const play = button("play", "play", toggle, "main");
  const time = el("input", {
    type: "range",
    min: 0,
    step: 1,
    value: 0,
    "aria-label": t("time"),
    class: "time",
  });
  time.addEventListener("input", () => step(Number(time.value) - clock.place));
  const readout = el("output", { class: "clock" });
  const element = el(
    "div",
    { class: "transport", role: "group", "aria-label": t("playback") },
    button("to_start", "start", () => step(-clock.place)),
    button("step_back", "back", () => step(-frame())),
    play,
    button("step_on", "on", () => step(frame())),
    time,
    readout,
    speedChoice(lab),
  );
  const follow = () => {
    const name = clock.playing ? "pause" : "play";
    if (play.dataset.shows !== name) {
      play.dataset.shows = name;
      play.replaceChildren(icon(name));
      play.setAttribute("aria-label", t(name));
      play.title = t(name);
    }
    const now = lab.recipe.t0 + clock.place * clock.spacing;
    time.max = String(clock.last);
    time.value = String(clock.place);
    readout.textContent = `${fixed(now, decimals(clock.spacing))} s`;
    time.setAttribute("aria-valuetext", `${fixed(now, 2)} s`);
  };
  follow();
  return { element, follow, toggle, step: (places) => step(places * frame()) };
}

function speedChoice(lab: Lab): HTMLElement {
  const known = SPEEDS.includes(lab.page.speed)
    ? SPEEDS
    : [...SPEEDS, lab.page.speed].sort((a, b) => a - b);
  const options = known.map((speed) => [String(speed), `${shown(speed)}×`] as const);
  return choice(t("speed"), options, String(lab.page.speed), (value) =>
    lab.changePage({ speed: Number(value) }),
  );
}

/** So many as tell places of a grid apart, three at most. */
function decimals(spacing: number): number {
  return Math.min(3, Math.max(2, Math.ceil(-Math.log10(Math.abs(spacing)))));
}
