// Begins: reads the address, starts the core, shows the laboratory or says in one line why not.

import { keepOffline, source } from "#source";
import { App } from "./app";
import { el, fill } from "./controls/dom";
import type { Core } from "./core/api";
import { openCore } from "./core/pool";
import { parsed } from "./recipe/address";
import { PRESETS } from "./recipe/presets";
import type { Page, Recipe } from "./recipe/recipe";
import { Lab } from "./run/lab";
import { preferred, speak, t } from "./words/language";
import { Refused } from "./words/refused";

const root = document.getElementById("lab")!;

function firstRecipe(): { recipe: Recipe; page: Page } {
  const page: Page = { view: "stage", speed: 1, compare: [] };
  const first = PRESETS.find((preset) => preset.key === "preset_150")!;
  return { recipe: first.recipe, page };
}

function theming(page: Page): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const set = () => {
    document.documentElement.dataset.theme = page.theme ?? (dark.matches ? "dark" : "light");
  };
  dark.addEventListener("change", set);
  set();
}

function wrong(line: string): void {
  const again = el("a", { href: "./" }, t("start_afresh"));
  again.href = location.pathname;
  fill(
    root,
    el("main", { class: "card refused" }, el("p", { role: "alert" }, line), el("p", {}, again)),
  );
}

function languageOf(hash: string): "en" | "es" {
  const found = /[#&]lang=(en|es)(&|$)/.exec(hash);
  return found ? (found[1] as "en" | "es") : preferred();
}

/** The address's recipe, or what a person sees first. */
function asked(): { recipe: Recipe; page: Page } {
  const only = location.hash
    .slice(1)
    .split("&")
    .filter((part) => !PAGE_ONLY.test(part) && part !== "");
  if (only.length > 0) return parsed(location.hash);
  const first = firstRecipe();
  if (location.hash.length < 2) return first;
  const { page } = parsed(`${location.hash}&system=simple&t_max=1`);
  return { recipe: first.recipe, page };
}
const PAGE_ONLY = /^(lang|theme|embed)=/;

async function begin(core: Promise<Core>): Promise<void> {
  speak(languageOf(location.hash));
  theming({} as Page);
  try {
    const { recipe, page } = asked();
    speak(page.lang ?? preferred());
    theming(page);
    const lab = new Lab(await core, recipe, page);
    new App(root, lab);
    await keepOffline();
  } catch (error) {
    if (error instanceof Refused) wrong(t("link_wrong", { why: t(error.key, error.values) }));
    else wrong(t("core_missing", { why: (error as Error).message }));
  }
}

const core = openCore(source());
void begin(core);
window.addEventListener("hashchange", () => location.reload());
