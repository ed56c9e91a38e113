// What is swung: the system, its start, the method. Parameters are those of the catalogue, with its
// ranges; a field appears for each, so that a new system needs nothing here.

import { catalogue, formOf, methodNamed, type ParameterRow, systemNamed } from "../core/catalogue";
import { checkOption, checkRange } from "../recipe/address";
import { radians } from "../recipe/angles";
import {
  EXACT,
  formRowOf,
  isDouble,
  methodsFor,
  type Options,
  parametersOf,
  type Recipe,
  systemOf,
} from "../recipe/recipe";
import type { Lab } from "../run/lab";
import { meaning, named, symbolOf, unitText } from "../words/catalogue";
import { t } from "../words/language";
import { choice, el, fill, unfolds } from "./dom";
import { type NumberField, numberField } from "./number_field";
import { worlds } from "./worlds";

const DEGREES = 180 / Math.PI;
const STEPS: Record<string, readonly [number, number]> = {
  step: [0.001, 0.2],
  tolerance: [1e-15, 1e-3],
  certify: [1e-9, 1],
  t_max: [5, 120],
};

/** The fields of the recipe; `follow` shows values that come from elsewhere. */
export class Panel {
  readonly element = el("div", { class: "panel" });
  private fields: [NumberField, (recipe: Recipe) => number][] = [];
  private made = "";

  constructor(private readonly lab: Lab) {
    this.follow();
  }

  follow(): void {
    const { recipe } = this.lab;
    const kind = [recipe.system, recipe.form, recipe.method, this.lab.hidden].join();
    if (kind !== this.made) this.make(kind);
    for (const [field, value] of this.fields) field.show(value(recipe));
  }

  private make(kind: string): void {
    const open = [...this.element.querySelectorAll("details")].map((each) => each.open);
    this.made = kind;
    this.fields = [];
    fill(
      this.element,
      unfolds(t("start"), open[0] ?? true, ...this.startFields()),
      unfolds(t("pendulum"), open[1] ?? true, ...this.systemFields()),
      unfolds(t("method_heading"), open[2] ?? false, ...this.methodFields()),
    );
  }

  private add(field: NumberField, value: (recipe: Recipe) => number): HTMLElement {
    this.fields.push([field, value]);
    return field.element;
  }

  private startFields(): HTMLElement[] {
    const { lab } = this;
    const system = systemOf(lab.recipe);
    return system.components.map((row, i) => {
      const angle = row.unit === "rad";
      const factor = angle ? DEGREES : 1;
      const take = (value: number) => {
        const state = [...lab.recipe.state];
        state[i] = angle ? radians(value) : value;
        lab.change({ state });
      };
      const field = numberField({
        label: t(angle ? "angle" : "rate"),
        symbol: symbolOf(row.name),
        unit: angle ? "°" : "rad/s",
        slider: angle ? [-180, 180] : [-10, 10],
        meaning: meaning(row.meaning),
        take,
      });
      return this.add(field, (recipe) => recipe.state[i] * factor);
    });
  }

  private systemFields(): (HTMLElement | null)[] {
    const { lab } = this;
    const { recipe } = lab;
    const systems = catalogue.systems.map((row) => [row.name, t(named(row.name))] as const);
    const system = choice(t("system"), systems, recipe.system, (name) => this.takeSystem(name));
    const forms = systemOf(recipe).forms;
    const form =
      forms.length < 2
        ? null
        : choice(
            t("form"),
            forms.map((row) => [row.name, meaning(row.meaning)] as const),
            recipe.form,
            (name) => this.takeForm(recipe.system, name),
          );
    const rows = formRowOf(recipe).parameters;
    const real = rows.findIndex((row) => row.name.startsWith("viscous"));
    const ideal = real < 0 ? rows : rows.slice(0, real);
    const parts = ideal.map((row) => this.parameter(row));
    const more = real < 0 ? [] : rows.slice(real).map((row) => this.parameter(row));
    const world = rows.some((row) => row.name === "gravity") ? worlds(lab) : null;
    return [system, form, ...parts, world, more.length ? unfolds(t("real"), true, ...more) : null];
  }

  private parameter(row: ParameterRow): HTMLElement | null {
    const { lab } = this;
    if (row.name === "gravity" && lab.hidden) return null;
    const field = numberField({
      label: meaning(row.meaning),
      symbol: symbolOf(row.name),
      unit: unitText(row.unit),
      slider: row.slider,
      take: (value) => {
        checkRange(row.name, value, row.range);
        lab.change({ parameters: { ...lab.recipe.parameters, [row.name]: value } });
      },
    });
    return this.add(field, (recipe) => recipe.parameters[row.name]);
  }

  private methodFields(): (HTMLElement | null)[] {
    const { lab } = this;
    const { recipe } = lab;
    const names = methodsFor(recipe, catalogue.methods);
    const options = names.map((name) => [name, name === EXACT ? t("exact") : name] as const);
    const row = methodNamed(recipe.method);
    const option = !row ? null : row.adaptive ? null : this.option("step", "s");
    const source = row ? el("p", { class: "note" }, row.source) : null;
    const until = numberField({
      label: t("until"),
      symbol: "t",
      unit: "s",
      slider: STEPS.t_max,
      take: (t_max) => lab.change({ t_max }),
    });
    return [
      choice(t("method"), options, recipe.method, (name) => this.takeMethod(name)),
      source,
      option,
      this.add(until, (each) => each.t_max),
    ];
  }

  private option(name: keyof Options, unit: string): HTMLElement {
    const { lab } = this;
    const field = numberField({
      label: t(name as "step"),
      unit,
      slider: STEPS[name],
      take: (value) => {
        checkOption(name, value);
        lab.change({ options: { ...lab.recipe.options, [name]: value } });
      },
    });
    return this.add(field, (recipe) => recipe.options[name] ?? 0);
  }

  private takeSystem(name: string): void {
    this.takeForm(name, systemNamed(name)!.forms[0].name);
  }

  private takeForm(name: string, form: string): void {
    const { lab } = this;
    const { recipe } = lab;
    const system = systemNamed(name)!;
    const same = system.components.length === recipe.state.length;
    const takes = methodNamed(recipe.method)?.systems.includes(name);
    lab.change({
      system: name,
      form,
      parameters: parametersOf(formOf(system, form)!, recipe.parameters),
      state: same ? recipe.state : system.components.map((row) => row.standard),
      ...(takes ? {} : { method: "taylor", options: {} }),
    });
  }

  private takeMethod(method: string): void {
    const { lab } = this;
    const row = methodNamed(method);
    const { certify, step } = lab.recipe.options;
    const options: Options = row && certify !== undefined ? { certify } : {};
    if (row && !row.adaptive) options.step = step ?? (isDouble(lab.recipe) ? 0.01 : 0.05);
    lab.change({ method, options });
  }
}
