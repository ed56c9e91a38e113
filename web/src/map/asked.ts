// What the map shows and until when, from the address; and the controls that choose it.

import { choice, el } from "../controls/dom";
import { numberField } from "../controls/number_field";
import { checkPage } from "../recipe/address";
import type { Page } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import { t } from "../words/language";
import type { Quantity } from "./level";

const UNTIL = 20; // s
const SLIDER = [5, 100] as const; // s

export const quantityOf = (page: Page): Quantity => page.map_quantity ?? "flip_time";
export const untilOf = (page: Page): number => page.map_t_max ?? UNTIL;

/** Chooses both; `changed` is called after the page has them. */
export function choices(lab: Lab, changed: () => void): HTMLElement {
  const change = (next: Partial<Page>) => {
    lab.changePage(next);
    changed();
  };
  const shown = choice(
    t("map_shows"),
    [
      ["flip_time", t("map_flips")],
      ["megno", t("map_chaos")],
    ],
    quantityOf(lab.page),
    (value) => change({ map_quantity: value === "megno" ? value : undefined }),
  );
  const until = numberField({
    label: t("map_until"),
    unit: "s",
    slider: SLIDER,
    take: (value) => {
      checkPage("map_t_max", value);
      change({ map_t_max: value === UNTIL ? undefined : value });
    },
  });
  until.show(untilOf(lab.page));
  return el("div", { class: "fold" }, shown, until.element);
}
