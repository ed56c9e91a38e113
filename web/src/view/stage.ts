// The stage: the pendulum, its trail, the linear one beside it, ghosts and neighbours.

import { isDouble } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import type { Motion } from "../run/motion";
import { stateAt } from "../run/motion";
import { fixed, t } from "../words/language";
import { barred, lengthsOf, massesOf, type Pane, panes, pivotAt, toScreen } from "./geometry";
import type { Surface } from "./svg";
import { theme } from "./theme";

/** What a person has laid on the stage. */
export interface Tools {
  ruler: boolean;
  cloud: ((place: number) => Float32Array | null) | null; // tips of neighbours, (n, 2) [m]
}

const TRAIL = 4; // s
const SHADES = 24;

/** Panes of the stage as it is now. */
export function stagePanes(lab: Lab, width: number, height: number): Pane[] {
  return panes(lab.recipe, lab.twin && lab.twinShown ? 2 : 1, width, height);
}

/** Draws everything at the place of the clock. */
export function drawStage(lab: Lab, tools: Tools, s: Surface, width: number, height: number): void {
  const [pane, second] = stagePanes(lab, width, height);
  const { motion, clock } = lab;
  if (tools.ruler) ruler(s, pane, lab, width, height);
  for (const each of second ? [pane, second] : [pane]) rest(s, each, lab);
  if (motion.count === 0) return;
  const place = Math.min(clock.place, motion.count - 1);
  const lost = lab.horizon !== null && motion.times[place] > lab.horizon;
  neighbours(s, pane, tools.cloud?.(place) ?? null);
  trail(s, pane, lab, motion, place);
  for (const ghost of lab.ghosts.list) {
    if (place < ghost.motion.count) {
      pendulum(s, pane, lab, ghost.motion, place, theme().methods[ghost.method], 0.5, true);
    }
  }
  pendulum(s, pane, lab, motion, place, theme().ink, lost ? 0.35 : 1, false);
  if (second && lab.twin && place < lab.twin.count) {
    trail(s, second, lab, lab.twin, place);
    pendulum(s, second, lab, lab.twin, place, theme().methods.linear, 1, false);
    titles(s, pane, second, height);
  }
}

function titles(s: Surface, pane: Pane, second: Pane, height: number): void {
  s.font = `12px ${theme().font}`;
  s.fillStyle = theme().soft;
  s.textAlign = "center";
  s.textBaseline = "bottom";
  s.fillText(t("non_linear"), pane.x, height - 6);
  s.fillText(t("linear_model"), second.x, height - 6);
}

/** The vertical, and the support. */
function rest(s: Surface, pane: Pane, lab: Lab): void {
  const length = lengthsOf(lab.recipe).reduce((sum, each) => sum + each, 0);
  const colours = theme();
  s.save();
  s.strokeStyle = colours.line;
  s.lineWidth = 1;
  s.setLineDash([2, 5]);
  s.beginPath();
  s.moveTo(pane.x, pane.y);
  s.lineTo(pane.x, pane.y + pane.scale * length);
  s.stroke();
  s.restore();
  s.strokeStyle = colours.line;
  s.lineWidth = 1.5;
  s.beginPath();
  s.moveTo(pane.x - 16, pane.y);
  s.lineTo(pane.x + 16, pane.y);
  s.stroke();
}

/** Where the tip was, the fainter the longer ago; past the horizon of trust only a shadow. */
function trail(s: Surface, pane: Pane, lab: Lab, motion: Motion, place: number): void {
  const first = Math.max(0, place - Math.round(TRAIL / Math.abs(motion.spacing)));
  const length = place - first;
  if (length < 2) return;
  const { size, positions, times } = motion;
  const colours = theme();
  const stride = Math.max(1, Math.floor(length / 480));
  s.lineWidth = 2;
  s.lineCap = "round";
  for (let shade = 0; shade < SHADES; ++shade) {
    const from = first + Math.floor((length * shade) / SHADES);
    const to = first + Math.floor((length * (shade + 1)) / SHADES);
    const lost = lab.horizon !== null && motion === lab.motion && times[to] > lab.horizon;
    s.globalAlpha = (lost ? 0.25 : 0.75) * ((shade + 1) / SHADES) ** 1.5;
    s.strokeStyle = lost ? colours.soft : colours.accent;
    s.beginPath();
    for (let i = from; i < to + stride; i += stride) {
      const at = Math.min(i, to);
      const [px, py] = pivotAt(lab.recipe, times[at]);
      const x = positions[at * size + size - 2] + px;
      const y = positions[at * size + size - 1] + py;
      if (i === from) s.moveTo(...toScreen(pane, x, y));
      else s.lineTo(...toScreen(pane, x, y));
    }
    s.stroke();
  }
  s.globalAlpha = 1;
  s.lineCap = "butt";
}

function pendulum(
  s: Surface,
  pane: Pane,
  lab: Lab,
  motion: Motion,
  place: number,
  colour: string,
  alpha: number,
  ghost: boolean,
): void {
  const { recipe } = lab;
  const { size, positions, times } = motion;
  const pivot = pivotAt(recipe, times[place]);
  const points = [toScreen(pane, ...pivot)];
  for (let i = 0; i < size; i += 2) {
    const [x, y] = [positions[place * size + i], positions[place * size + i + 1]];
    points.push(toScreen(pane, x + pivot[0], y + pivot[1]));
  }
  const bars = barred(recipe);
  s.globalAlpha = alpha;
  s.strokeStyle = colour;
  s.lineCap = "round";
  s.lineWidth = ghost ? 2 : bars ? 9 : 2.5;
  s.beginPath();
  points.forEach(([x, y], i) => {
    if (i === 0) s.moveTo(x, y);
    else s.lineTo(x, y);
  });
  s.lineJoin = "round";
  s.stroke();
  s.lineCap = "butt";
  bobs(s, recipe, points, colour, ghost, bars);
  s.globalAlpha = 1;
}

/** Radius of a bob on the screen [px]: as its volume goes. */
export function bobRadius(mass: number): number {
  return Math.min(20, Math.max(7, 11 * Math.cbrt(mass)));
}

function bobs(
  s: Surface,
  recipe: Lab["recipe"],
  points: [number, number][],
  colour: string,
  ghost: boolean,
  bars: boolean,
): void {
  const masses = massesOf(recipe);
  points.forEach(([x, y], i) => {
    const radius = i === 0 ? 4 : bars ? 5 : ghost ? 6 : bobRadius(masses[i - 1]);
    s.beginPath();
    s.arc(x, y, radius, 0, 2 * Math.PI);
    s.fillStyle = bars || i === 0 ? theme().paper : colour;
    s.fill();
    if (!bars && i > 0) return;
    s.strokeStyle = colour;
    s.lineWidth = 1.5;
    s.stroke();
  });
}

function neighbours(s: Surface, pane: Pane, tips: Float32Array | null): void {
  if (!tips) return;
  s.fillStyle = theme().second;
  s.globalAlpha = 0.5;
  for (let i = 0; i < tips.length; i += 2) {
    const [x, y] = toScreen(pane, tips[i], tips[i + 1]);
    s.fillRect(x - 0.8, y - 0.8, 1.6, 1.6);
  }
  s.globalAlpha = 1;
}

/** Lines a tenth or a whole unit of length apart. */
function ruler(s: Surface, pane: Pane, lab: Lab, width: number, height: number): void {
  const reach = lengthsOf(lab.recipe).reduce((sum, each) => sum + each, 0);
  const unit = 10 ** Math.round(Math.log10(reach / 8));
  const colours = theme();
  s.font = `10px ${colours.font}`;
  s.fillStyle = colours.soft;
  s.strokeStyle = colours.grid;
  s.lineWidth = 1;
  s.textAlign = "left";
  s.textBaseline = "middle";
  for (let i = -40; i <= 40; ++i) {
    const y = pane.y + pane.scale * unit * i;
    if (y < 4 || y > height - 4) continue;
    s.beginPath();
    s.moveTo(i % 5 === 0 ? 0 : width - 8, y);
    s.lineTo(width, y);
    s.stroke();
    if (i % 5 === 0) s.fillText(`${fixed(i * unit, unit < 0.1 ? 2 : 1)} m`, 4, y - 7);
  }
}

/** What the pendulum does, in a sentence. */
export function describeStage(lab: Lab): string {
  const { motion, clock, recipe } = lab;
  if (motion.count === 0) return t("stage_empty");
  const place = Math.min(clock.place, motion.count - 1);
  const state = stateAt(motion, place);
  const time = fixed(motion.times[place], 2);
  const degrees = (value: number) => fixed((value * 180) / Math.PI, 1);
  if (isDouble(recipe)) {
    return t("stage_double", { time, theta1: degrees(state[0]), theta2: degrees(state[1]) });
  }
  const way = state[1] === 0 ? "way_rest" : state[1] > 0 ? "way_right" : "way_left";
  return t("stage_single", { time, theta: degrees(state[0]), way: t(way) });
}
