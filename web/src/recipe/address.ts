// The address is the recipe: what stands behind the # of a link, read and written as
// `pendula.lab.address` does. Nothing is clamped or ignored; what is wrong is refused in one line.

import addressRows from "../../../src/pendula/lab/address.json";
import { catalogue, type FormRow, formOf, methodNamed, systemNamed } from "../core/catalogue";
import { Refused } from "../words/refused";
import { EXACT, type Options, type Page, type Recipe, standardOf } from "./recipe";

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
const RUN = addressRows.recipe.map((row) => row.key);
const PAGE = addressRows.page.map((row) => row.key);
const OPTIONS = catalogue.options.map((row) => row.name);

/** What a link says. */
export interface Address {
  recipe: Recipe;
  page: Page;
}

/** Reads what follows the # of a link; throws `Refused`, naming the key. */
export function parsed(hash: string): Address {
  const given = entries(hash);
  if (given.size === 0) throw new Refused("link_empty");
  const name = needed(given, "system");
  const system = systemNamed(name);
  if (!system) {
    const choices = catalogue.systems.map((row) => row.name).join(", ");
    throw new Refused("link_choice", { key: "system", value: name, choices });
  }
  const formName = given.get("form") ?? system.forms[0].name;
  const form = formOf(system, formName);
  if (!form || (given.has("form") && formName === "")) {
    const choices = system.forms.map((row) => row.name).join(", ") || "—";
    throw new Refused("link_choice", { key: "form", value: formName, choices });
  }
  const known = [...RUN, ...PAGE, ...OPTIONS, ...form.parameters.map((row) => row.name)];
  for (const key of given.keys()) {
    if (!known.includes(key)) throw new Refused("link_unknown", { key });
  }
  const recipe: Recipe = {
    system: name,
    form: formName,
    parameters: parametersFrom(given, form),
    state: given.has("state")
      ? listOf(given, "state", system.components.length)
      : system.components.map((row) => row.standard),
    t0: given.has("t0") ? numberOf("t0", given.get("t0")!) : 0,
    t_max: numberOf("t_max", needed(given, "t_max")),
    method: given.get("method") ?? "taylor",
    options: optionsFrom(given),
  };
  if (given.has("every")) recipe.every = numberOf("every", given.get("every")!);
  checked(recipe);
  return { recipe, page: pageFrom(given) };
}

function entries(hash: string): Map<string, string> {
  const found = new Map<string, string>();
  const text = hash.replace(/^#/, "");
  for (const entry of text === "" ? [] : text.split("&")) {
    const at = entry.indexOf("=");
    const key = at < 0 ? entry : entry.slice(0, at);
    if (at < 0) throw new Refused("link_no_value", { key });
    if (found.has(key)) throw new Refused("link_twice", { key });
    found.set(key, decodedPart(entry.slice(at + 1), key));
  }
  return found;
}

function decodedPart(text: string, key: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    throw new Refused("link_encoding", { key });
  }
}

function needed(given: Map<string, string>, key: string): string {
  const value = given.get(key);
  if (value === undefined) throw new Refused("link_needed", { key });
  return value;
}

function numberOf(key: string, text: string): number {
  if (!NUMBER.test(text)) throw new Refused("link_number", { key, value: text });
  const value = Number(text);
  if (!Number.isFinite(value)) throw new Refused("link_number", { key, value: text });
  if (value === 0 && /[1-9]/.test(text.split(/e/i)[0])) {
    throw new Refused("link_tiny", { key, value: text });
  }
  return value;
}

function listOf(given: Map<string, string>, key: string, count: number): number[] {
  const values = given.get(key)!.split(",");
  if (values.length !== count)
    throw new Refused("link_count", { key, count, value: values.length });
  return values.map((text) => numberOf(key, text));
}

function parametersFrom(given: Map<string, string>, form: FormRow): Record<string, number> {
  const values: Record<string, number> = {};
  for (const row of form.parameters) {
    const text = given.get(row.name);
    if (text !== undefined) values[row.name] = numberOf(row.name, text);
    else if (row.standard === null && row.same_as === "") {
      throw new Refused("link_needed", { key: row.name });
    }
  }
  for (const row of form.parameters) {
    values[row.name] ??= values[row.same_as] ?? standardOf(form, row);
    checkRange(row.name, values[row.name], row.range);
  }
  return values;
}

/** Refuses what is outside a parameter's range. */
export function checkRange(key: string, value: number, range: string): void {
  if (range === "positive" && !(value > 0)) throw new Refused("rule_positive", { key, value });
  if (range === "not_negative" && value < 0) throw new Refused("rule_not_negative", { key, value });
}

function optionsFrom(given: Map<string, string>): Options {
  const options: Record<string, number> = {};
  for (const row of catalogue.options) {
    const text = given.get(row.name);
    if (text === undefined) continue;
    const value = numberOf(row.name, text);
    checkOption(row.name, value);
    if (row.name === "digits") throw new Refused("link_digits", { key: "digits", value });
    options[row.name] = value;
  }
  return options;
}

/** Refuses a value outside an option's range. */
export function checkOption(key: string, value: number): void {
  const row = catalogue.options.find((each) => each.name === key)!;
  const most = row.most ?? Number.POSITIVE_INFINITY;
  const low = row.least === 0 ? value <= 0 : value < row.least;
  if (row.whole && !Number.isInteger(value)) throw new Refused("rule_whole", { key, value });
  if (low || value > most) {
    throw new Refused("rule_range", { key, value, least: row.least, most: row.most ?? "∞" });
  }
}

const LARGEST_ANGLE = 2 ** 26; // rad: the reach of the core's sine

/** Refuses what a run could not be made with; the core checks the rest. */
export function checked(recipe: Recipe): void {
  const { system, state, t0, t_max, every, method, options } = recipe;
  const span = Math.abs(t_max - t0);
  const row = methodNamed(method);
  const { capabilities } = systemNamed(system)!;
  const far = state.slice(0, state.length / 2).find((value) => Math.abs(value) >= LARGEST_ANGLE);
  if (capabilities.periodic && far !== undefined) {
    throw new Refused("rule_angle", { key: "state", value: far });
  }
  if (!(span > 0)) throw new Refused("rule_differs", { key: "t_max", value: t_max });
  const closed = capabilities.closed_form;
  if (method === EXACT ? !closed : !row?.systems.includes(system)) {
    const names = catalogue.methods.filter((each) => each.systems.includes(system));
    const choices = [...(closed ? [EXACT] : []), ...names.map((each) => each.name)].join(", ");
    throw new Refused("link_method", { system, value: method, choices });
  }
  checkTaken(options, method);
  if (row && !row.adaptive) {
    if (options.step === undefined) throw new Refused("rule_step_needed", { key: "step", method });
    if (options.step > span)
      throw new Refused("rule_within", { key: "step", value: options.step, span });
  }
  if (every !== undefined && !(every > 0 && every <= span)) {
    throw new Refused("rule_within", { key: "every", value: every, span });
  }
}

function checkTaken(options: Options, method: string): void {
  const row = methodNamed(method);
  const taken = (key: string) => {
    if (!row) return false;
    if (key === "step") return !row.adaptive;
    return key !== "tolerance" || row.adaptive;
  };
  for (const key of Object.keys(options)) {
    if (!taken(key)) throw new Refused("rule_not_taken", { key, method });
  }
}

function pageFrom(given: Map<string, string>): Page {
  const page: Record<string, unknown> = { view: "stage", speed: 1, compare: [] };
  for (const row of addressRows.page) {
    const text = given.get(row.key);
    if (text !== undefined) page[row.key] = pageValue(row, text, given);
  }
  return page as unknown as Page;
}

/** Refuses a number outside the range of a key of the page. */
export function checkPage(key: string, value: number): void {
  const row: PageRow = addressRows.page.find((each) => each.key === key)!;
  if (value < row.least! || value > row.most!) {
    throw new Refused("rule_range", { key, value, least: row.least!, most: row.most! });
  }
}

type PageRow = { key: string; kind: string; choices?: string[]; least?: number; most?: number };

function pageValue(row: PageRow, value: string, given: Map<string, string>): unknown {
  const { key } = row;
  if (row.kind === "choice") {
    if (!row.choices!.includes(value)) {
      throw new Refused("link_choice", { key, value, choices: row.choices!.join(", ") });
    }
    return key === "embed" ? true : value;
  }
  if (row.kind === "number") {
    const number = numberOf(key, value);
    checkPage(key, number);
    return number;
  }
  if (row.kind === "range") {
    const [low, high] = listOf(given, key, 2);
    if (!(low < high)) throw new Refused("link_rising", { key, value });
    return [low, high];
  }
  const names = value.split(",");
  const known = [EXACT, ...catalogue.methods.map((each) => each.name)];
  const wrong = names.find((name) => !known.includes(name));
  if (wrong !== undefined) {
    throw new Refused("link_choice", { key, value: wrong, choices: known.join(", ") });
  }
  if (names.length > row.most! || new Set(names).size < names.length) {
    throw new Refused("link_most", { key, most: row.most!, value });
  }
  return names;
}

/** A number of an address: the shortest decimal that gives the double back. */
function text(value: number): string {
  return Object.is(value, -0) ? "-0" : String(value).replace("e+", "e");
}

/** What stands behind the # of a link to a recipe. */
export function written(recipe: Recipe, page?: Partial<Page>): string {
  const { system, form, parameters, options } = recipe;
  const rows = formOf(systemNamed(system)!, form)!.parameters;
  const named = rows.filter((row) => !(parameters[row.name] === 0 && row.standard === 0));
  const parts: [string, string][] = [
    ["system", system],
    ...(form === "" ? [] : [["form", form] as [string, string]]),
    ...named.map((row): [string, string] => [row.name, text(parameters[row.name])]),
    ["state", recipe.state.map(text).join(",")],
    ...(recipe.t0 === 0 ? [] : [["t0", text(recipe.t0)] as [string, string]]),
    ["t_max", text(recipe.t_max)],
    ...(recipe.every === undefined ? [] : [["every", text(recipe.every)] as [string, string]]),
    ["method", recipe.method],
    ...Object.entries(options).map(([key, value]): [string, string] => [key, text(value)]),
    ...(page ? pageParts(page) : []),
  ];
  return parts
    .map(([key, value]) => `${key}=${encodeURI(value).replace(/[&#+]/g, encodeURIComponent)}`)
    .join("&");
}

function pageParts(page: Partial<Page>): [string, string][] {
  const parts: [string, string][] = [];
  if (page.lang) parts.push(["lang", page.lang]);
  if (page.theme) parts.push(["theme", page.theme]);
  if (page.embed) parts.push(["embed", "1"]);
  if (page.view && page.view !== "stage") parts.push(["view", page.view]);
  if (page.speed !== undefined && page.speed !== 1) parts.push(["speed", text(page.speed)]);
  if (page.compare?.length) parts.push(["compare", page.compare.join(",")]);
  for (const key of ["map_theta1", "map_theta2"] as const) {
    const range = page[key];
    if (range) parts.push([key, range.map(text).join(",")]);
  }
  if (page.map_quantity) parts.push(["map_quantity", page.map_quantity]);
  if (page.map_t_max !== undefined) parts.push(["map_t_max", text(page.map_t_max)]);
  return parts;
}
