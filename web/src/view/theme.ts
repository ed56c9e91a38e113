// Colours and fonts of the drawings: those of the style sheet, in the light and in the dark.

/** What a drawing may use. */
export interface Theme {
  ink: string;
  soft: string; // labels
  line: string; // axes
  grid: string;
  paper: string;
  accent: string;
  second: string;
  warm: string;
  methods: Record<string, string>;
  font: string;
  symbols: string;
}

const NAMES = ["ink", "soft", "line", "grid", "paper", "accent", "second", "warm"] as const;

// Okabe & Ito's palette ("Color Universal Design", 2008), as in the figures of the package.
const METHODS: Record<string, string> = {
  exact: "--ink",
  linear: "--linear",
  euler: "#d55e00",
  heun: "#2b8cc4",
  rk4: "#009e73",
  dop853: "#3fa9e0",
  taylor: "--accent",
  "symplectic-euler": "#b48ae0",
  verlet: "#a578d3",
  yoshida4: "#9a68cf",
  yoshida6: "#8650be",
  yoshida8: "#7a4fc0",
  midpoint: "#c9a55a",
  gauss4: "#c19337",
  gauss6: "#b0822a",
  gauss8: "#a2751f",
};

let known: Theme | null = null;

/** The colours now. */
export function theme(): Theme {
  if (known) return known;
  const style = getComputedStyle(document.documentElement);
  const value = (name: string) => style.getPropertyValue(name).trim();
  const colours = Object.fromEntries(NAMES.map((name) => [name, value(`--${name}`)]));
  const methods = Object.fromEntries(
    Object.entries(METHODS).map(([name, colour]) => [
      name,
      colour.startsWith("--") ? value(colour) : colour,
    ]),
  );
  known = { ...colours, methods, font: value("--sans"), symbols: value("--serif") } as Theme;
  return known;
}

/** To be called when the colours of the page have changed. */
export function forgetTheme(): void {
  known = null;
}
