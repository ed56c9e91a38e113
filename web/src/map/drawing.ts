// The picture of the flip map: its levels one over the other, the cross of the chosen start, the axes.

import { DEGREES } from "../view/graphs";
import type { Axis, Plot } from "../view/plot";
import { theme } from "../view/theme";
import type { Level, Range } from "./level";

/** An axis of the map; its letter is drawn beside it. */
export function axis([low, high]: Range): Axis {
  return { low: low * DEGREES, high: high * DEGREES, label: "", kind: "degrees" };
}

/** Draws everything; the cross stands at a start [rad]. */
export function drawMap(plot: Plot, levels: readonly Level[], cross: [number, number]): void {
  plot.frame();
  plot.clipped(() => {
    for (const level of levels) layer(plot, level);
    crossAt(plot, cross, "#fff", 3.5);
    crossAt(plot, cross, "#111", 1.5);
  });
  letter(plot, "θ₁", plot.right - LETTER, plot.bottom - LETTER);
  letter(plot, "θ₂", plot.left, plot.top);
}

const LETTER = 26; // px: side of the square that a letter stands on

/** The letter of an axis, in a corner of the map, where no number stands. */
function letter(plot: Plot, text: string, x: number, y: number): void {
  const { surface: s } = plot;
  s.fillStyle = theme().paper;
  s.fillRect(x, y, LETTER, LETTER);
  s.font = `italic 16px ${theme().symbols}`;
  s.fillStyle = theme().ink;
  s.textAlign = "center";
  s.textBaseline = "middle";
  s.fillText(text, x + LETTER / 2, y + LETTER / 2);
}

function layer(plot: Plot, level: Level): void {
  const { theta1, theta2 } = level.rectangle;
  const [x, right] = theta1.map((value) => plot.px(value * DEGREES));
  const [bottom, y] = theta2.map((value) => plot.py(value * DEGREES));
  plot.surface.imageSmoothingEnabled = false;
  plot.surface.drawImage(level.canvas, x, y, right - x, bottom - y);
}

function crossAt(
  plot: Plot,
  [theta1, theta2]: [number, number],
  colour: string,
  width: number,
): void {
  const { surface: s } = plot;
  const [x, y] = [plot.px(theta1 * DEGREES), plot.py(theta2 * DEGREES)];
  s.strokeStyle = colour;
  s.lineWidth = width;
  s.beginPath();
  s.moveTo(x - 11, y);
  s.lineTo(x + 11, y);
  s.moveTo(x, y - 11);
  s.lineTo(x, y + 11);
  s.stroke();
}
