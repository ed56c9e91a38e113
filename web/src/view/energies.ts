// The energies now, as bars; with friction or a drive also the work done since the start and the heat
// given off, and how well they balance.

import { entryNow, exchanges } from "../run/balance";
import type { Lab } from "../run/lab";
import { fixed, powerOfTen, shown, t } from "../words/language";
import type { Surface } from "./svg";
import { theme } from "./theme";

type Bar = readonly [name: string, value: number, colour: string]; // J

const HIGHEST = 46; // px
const HALF = 8; // px: of a bar

/** Kinetic and potential energy at the clock's place, and their sum at the start [J]. */
function energies({ motion, clock }: Lab) {
  const place = Math.max(0, Math.min(clock.place, motion.count - 1));
  const [kinetic, potential] = [motion.kinetic[place], motion.potential[place]];
  return { kinetic, potential, start: motion.kinetic[0] + motion.potential[0] };
}

function bars(lab: Lab): Bar[] {
  const { kinetic, potential } = energies(lab);
  const own: Bar[] = [
    [t("kinetic"), kinetic, theme().accent],
    [t("potential"), potential, theme().second],
    [t("total"), kinetic + potential, theme().ink],
  ];
  if (!exchanges(lab)) return own;
  const at = entryNow(lab);
  const of = (values?: Float64Array) => (at === null ? Number.NaN : values![at]);
  return [
    ...own,
    [t("work"), of(lab.balance?.work), theme().methods.linear],
    [t("heat"), of(lab.balance?.heat), theme().warm],
  ];
}

export function drawEnergies(lab: Lab, s: Surface, width: number, height: number): void {
  if (lab.motion.count === 0) return;
  const all = bars(lab);
  const sizes = all.map(([, value]) => Math.abs(value)).filter((size) => !Number.isNaN(size));
  const most = Math.max(energies(lab).start, ...sizes, 1e-300) * 1.05;
  const high = Math.min(HIGHEST, height / all.length);
  s.font = `12px ${theme().font}`;
  s.textBaseline = "middle";
  all.forEach(([name, value, colour], i) => {
    const y = (i + 0.5) * high;
    const [left, right] = [92, width - 84];
    s.fillStyle = theme().grid;
    s.fillRect(left, y - HALF, right - left, 2 * HALF);
    s.fillStyle = colour;
    s.globalAlpha = value < 0 ? 0.45 : 1; // taken away: the number has its sign
    const long = Number.isNaN(value) ? 0 : Math.abs(value) / most;
    s.fillRect(left, y - HALF, (right - left) * long, 2 * HALF);
    s.globalAlpha = 1;
    s.fillStyle = theme().ink;
    s.textAlign = "left";
    s.fillText(name, 4, y);
    s.textAlign = "right";
    s.fillText(Number.isNaN(value) ? "…" : `${fixed(value, 3)} J`, width - 4, y);
  });
}

/** In words, with the balance. */
export function describeEnergies(lab: Lab): string {
  const { kinetic, potential, start } = energies(lab);
  const values = { kinetic: shown(kinetic), potential: shown(potential) };
  if (!exchanges(lab)) {
    return t("energy_text", { ...values, change: powerOfTen(kinetic + potential - start) });
  }
  const at = entryNow(lab);
  if (at === null) return t("energy_text_waits", values);
  const { work, heat, error } = lab.balance!;
  return t("energy_text_real", {
    ...values,
    work: shown(work[at]),
    heat: shown(heat[at]),
    error: powerOfTen(error[at]),
  });
}
