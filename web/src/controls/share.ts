// Sharing: the link, the program in Python, the stage for another page, numbers, pictures, a video.

import type { App } from "../app";
import { csvOf } from "../out/csv";
import { copy, record, save } from "../out/files";
import { pngOf, svgOf } from "../out/pictures";
import { written } from "../recipe/address";
import { inPython } from "../recipe/python";
import { t } from "../words/language";
import type { Key } from "../words/words";
import { el, unfolds } from "./dom";

/** The menu. */
export function shareMenu(app: App): HTMLElement {
  const { lab } = app;
  const name = () => `pendula-${lab.recipe.system}`;
  const hash = (page = {}) => written(lab.recipe, { ...lab.page, ...page });
  const here = () => location.href.split("#")[0];
  const embed = () =>
    `<iframe src="${here()}#${hash({ embed: true }).replaceAll("&", "&amp;")}" title="Pendula" width="100%" height="560"></iframe>`;
  const menu = unfolds(
    t("share"),
    false,
    item("copy_link", () => give(app, `${here()}#${hash()}`)),
    item("copy_python", () => give(app, inPython(lab.recipe))),
    item("copy_embed", () => give(app, embed())),
    item("save_csv", async () => {
      const text = await csvOf(lab.core, lab.recipe, lab.motion);
      keep(app, `${name()}.csv`, text, "text/csv");
    }),
    item("save_png", async () =>
      keep(app, `${name()}.png`, await pngOf(app.figures()), "image/png"),
    ),
    item("save_svg", () => keep(app, `${name()}.svg`, svgOf(app.figures()), "image/svg+xml")),
    recording(app, name),
    el("p", { class: "note" }, t("help_text")),
  );
  menu.classList.add("menu");
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    menu.open = false;
    menu.querySelector("summary")!.focus();
  });
  menu.addEventListener("focusout", ({ relatedTarget }) => {
    if (relatedTarget && !menu.contains(relatedTarget as Node)) menu.open = false;
  });
  return menu;
}

function item(key: Key, onclick: () => void | Promise<void>): HTMLButtonElement {
  return el("button", { type: "button", class: "quiet", onclick }, t(key));
}

async function give(app: App, text: string): Promise<void> {
  if (await copy(text)) app.say(t("copied"));
  else app.say(t("not_copied"), el("code", {}, text));
}

function keep(app: App, name: string, data: BlobPart, type: string): void {
  save(name, data, type);
  app.say(t("saved", { name }));
}

function recording(app: App, name: () => string): HTMLElement | null {
  if (typeof MediaRecorder === "undefined") return null;
  let stop: (() => void) | null = null;
  const made = item("record", () => {
    if (stop) stop();
    stop = stop ? null : record(app.figures()[0].canvas, name());
    made.textContent = t(stop ? "record_stop" : "record");
    if (stop) app.lab.clock.play();
  });
  return made;
}
