// The stage and the figures beside it as one picture, one below the other.

import type { Figure } from "../view/figure";
import { theme } from "../view/theme";

const GAP = 12; // px

/** One SVG file of all. */
export function svgOf(figures: readonly Figure[]): string {
  let height = 0;
  let width = 0;
  const parts = figures.map((figure) => {
    const [wide, high] = figure.size;
    const part = figure.svg().replace("<svg ", `<svg y="${height}" `);
    height += high + GAP;
    width = Math.max(width, wide);
    return part;
  });
  const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
  const ground = `<rect width="${width}" height="${height}" fill="${theme().paper}"/>`;
  return `<svg xmlns="http://www.w3.org/2000/svg" ${size}>${ground}\n${parts.join("")}</svg>\n`;
}

/** One PNG file of all, with the pixels of the screen. */
export function pngOf(figures: readonly Figure[]): Promise<Blob> {
  const canvases = figures.map((figure) => figure.canvas);
  const sheet = document.createElement("canvas");
  sheet.width = Math.max(...canvases.map((canvas) => canvas.width));
  sheet.height = canvases.reduce((sum, canvas) => sum + canvas.height + GAP, 0);
  const context = sheet.getContext("2d")!;
  context.fillStyle = theme().paper;
  context.fillRect(0, 0, sheet.width, sheet.height);
  let y = 0;
  for (const canvas of canvases) {
    context.drawImage(canvas, 0, y);
    y += canvas.height + GAP;
  }
  return new Promise((done, fail) =>
    sheet.toBlob((blob) => (blob ? done(blob) : fail(new Error("PNG"))), "image/png"),
  );
}
