// The picture of the flip map: its levels one over the other, the cross of the chosen start, the axes.

import { DEGREES } from "../view/graphs";
import type { Axis, Plot } from "../view/plot";
import { theme } from "../view/theme";
import type { Level, Range } from "./explorer";

/** An axis of the map; its letter is drawn beside it. */
export function axis([low, high]: Range): Axis {
  return { low: low * DEGREES, high: high * DEGREES, label: "", kind: "degrees" };
}

/** Draws everything; the cross stands at a start [rad]. */
export function drawMap(
  plot: Plot,
  levels: readonly Level[],
  cross: [number, number],
  height: number,
): void {
  plot.frame();
  plot.clipped(() => {
    for (const level of levels) layer(plot, level);
    crossAt(plot, cross, "#fff", 3.5);
    crossAt(plot, cross, "#111", 1.5);
  });
  const { surface: s } = plot;
  s.font = `italic 16px ${theme().symbols}`;
  s.fillStyle = theme().ink;
  s.textAlign = "right";
  s.textBaseline = "bottom";
  s.fillText("θ₁", plot.right, height - 1);
  s.textAlign = "left";
  s.textBaseline = "top";
  s.fillText("θ₂", 2, plot.top);
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
