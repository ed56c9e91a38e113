// Drawings of buttons, 24 by 24, in the colour of the text.

const PATHS: Record<string, string> = {
  play: "M8 5.5v13l10.5-6.5z",
  pause: "M7 5.5h3.5v13H7zM13.5 5.5H17v13h-3.5z",
  start: "M6 6h2v12H6zM18.5 6v12L9.5 12z",
  back: "M14.5 6v12L6 12zM16.5 6h2v12h-2z",
  on: "M9.5 6v12l8.5-6zM5.5 6h2v12h-2z",
  theme: "M12 4a8 8 0 0 0 0 16 8 8 0 0 0 0-16zm0 2a6 6 0 0 1 0 12z",
  plus: "M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",
  minus: "M5 11h14v2H5z",
  home: "M12 4 4 11h2.5v8h4v-5h3v5h4v-8H20z",
};
const SVG = "http://www.w3.org/2000/svg";

/** A drawing by its name. */
export function icon(name: string): SVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}
