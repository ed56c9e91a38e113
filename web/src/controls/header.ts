// The head of the page: examples, sharing, language, colours.

import type { App } from "../app";
import { written } from "../recipe/address";
import { PRESETS } from "../recipe/presets";
import type { Recipe } from "../recipe/recipe";
import { current, speak, t } from "../words/language";
import { choice, el } from "./dom";
import { shareMenu } from "./share";
import { button } from "./transport";

/** Makes the head; an embedded stage has a link to the whole laboratory instead. */
export function header(app: App): HTMLElement {
  const { lab } = app;
  const name = el("h1", {}, "Pendula", el("span", {}, t("title")));
  if (lab.page.embed) {
    const open = el("a", { href: "#", target: "_blank", rel: "noopener" }, t("embed_open"));
    open.addEventListener("click", () => {
      open.href = location.href.replace("&embed=1", "");
    });
    return el("header", {}, name, open);
  }
  return el("header", {}, name, examples(app), shareMenu(app), language(app), colours(app));
}

function examples(app: App): HTMLElement {
  const { lab } = app;
  const options = PRESETS.map((preset) => [preset.key, t(preset.key)] as const);
  const told = (recipe: Recipe, compare?: readonly string[]) =>
    written(recipe, { compare: [...(compare ?? [])] });
  const now = told(lab.recipe, lab.page.compare);
  const chosen = PRESETS.find(({ recipe, page }) => told(recipe, page.compare) === now)?.key ?? "";
  const all = [["", t("examples_choose")] as const, ...options];
  return choice(t("examples"), all, chosen, (key) => {
    const preset = PRESETS.find((each) => each.key === key);
    if (!preset) return;
    lab.hidden = false;
    lab.cloudWanted = preset.cloud ?? false;
    lab.changePage({ speed: 1, ...preset.page });
    lab.change(
      preset.recipe.every === undefined ? { ...preset.recipe, every: undefined } : preset.recipe,
    );
    lab.clock.play();
    app.build();
  });
}

function language(app: App): HTMLElement {
  const other = current() === "en" ? "es" : "en";
  return el(
    "button",
    {
      type: "button",
      class: "quiet",
      lang: other,
      onclick: () => {
        speak(other);
        app.lab.changePage({ lang: other });
        app.build();
      },
    },
    t("language"),
  );
}

function colours(app: App): HTMLElement {
  return button("theme", "theme", () => {
    const { dataset } = document.documentElement;
    const theme = dataset.theme === "dark" ? "light" : "dark";
    dataset.theme = theme;
    app.recolour();
    app.lab.changePage({ theme });
  });
}
