// Elements of the page, made without markup in strings: the page's policy forbids inline styles and
// scripts, and what a person typed never becomes markup.

type Value = string | number | boolean | ((event: never) => void);
type Child = Node | string | null | undefined | false;

/**
 * An element with attributes, listeners (`onclick: …`) and children.
 * A `true` attribute stands without a value, a `false` one is left out.
 */
export function el<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      made.addEventListener(name.slice(2), value as unknown as EventListener);
    } else if (value !== false) made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.filter((child): child is Node | string => Boolean(child)));
  return made;
}

/** Takes the place of all children. */
export function fill(parent: Element, ...children: Child[]): void {
  parent.replaceChildren(...children.filter((child): child is Node | string => Boolean(child)));
}

let last = 0;

/** A name for an element that another refers to. */
export function fresh(name: string): string {
  return `${name}-${++last}`;
}

/** A list of choices with a label. */
export function choice(
  label: string,
  options: readonly (readonly [value: string, text: string])[],
  chosen: string,
  onchange: (value: string) => void,
): HTMLElement {
  const id = fresh("choice");
  const select = el("select", {
    id,
    onchange: (event: Event) => onchange((event.target as HTMLSelectElement).value),
  });
  for (const [value, text] of options) {
    select.append(el("option", { value, selected: value === chosen }, text));
  }
  return el("div", { class: "field" }, el("label", { for: id }, label), select);
}

/** A box to tick, with its label. */
export function tick(
  label: string,
  on: boolean,
  onchange: (on: boolean) => void,
): HTMLLabelElement {
  const box = el("input", {
    type: "checkbox",
    checked: on,
    onchange: (event: Event) => onchange((event.target as HTMLInputElement).checked),
  });
  return el("label", { class: "tick" }, box, el("span", {}, label));
}

/** A part that unfolds. */
export function unfolds(title: string, open: boolean, ...children: Child[]): HTMLDetailsElement {
  return el(
    "details",
    { open },
    el("summary", {}, title),
    el("div", { class: "fold" }, ...children),
  );
}
