// A surface with those calls of a canvas that the views make, which writes SVG: a view draws its
// picture for the screen and for a file by the same code.

/** The calls of a canvas that the views make. */
export type Surface = Pick<
  CanvasRenderingContext2D,
  | "save"
  | "restore"
  | "beginPath"
  | "closePath"
  | "moveTo"
  | "lineTo"
  | "arc"
  | "rect"
  | "stroke"
  | "fill"
  | "fillRect"
  | "fillText"
  | "setLineDash"
  | "clip"
  | "translate"
  | "rotate"
  | "fillStyle"
  | "strokeStyle"
  | "lineWidth"
  | "lineCap"
  | "lineJoin"
  | "globalAlpha"
  | "font"
  | "textAlign"
  | "textBaseline"
  | "imageSmoothingEnabled"
> & {
  /** Only whole canvases are drawn. */
  drawImage(canvas: HTMLCanvasElement, x: number, y: number, w: number, h: number): void;
};

const ANCHORS: Record<string, string> = { center: "middle", right: "end", end: "end" };
const BASELINES: Record<string, string> = { middle: "central", top: "hanging", bottom: "auto" };

const STATE = {
  fillStyle: "#000" as string | CanvasGradient | CanvasPattern,
  strokeStyle: "#000" as string | CanvasGradient | CanvasPattern,
  lineWidth: 1,
  lineCap: "butt" as CanvasLineCap,
  lineJoin: "miter" as CanvasLineJoin,
  globalAlpha: 1,
  font: "10px sans-serif",
  textAlign: "start" as CanvasTextAlign,
  textBaseline: "alphabetic" as CanvasTextBaseline,
};
type State = typeof STATE & { dash: number[]; open: number };

/** A surface that writes SVG; `text()` is the file. */
export class SvgSurface implements Surface {
  fillStyle = STATE.fillStyle;
  strokeStyle = STATE.strokeStyle;
  lineWidth = STATE.lineWidth;
  lineCap = STATE.lineCap;
  lineJoin = STATE.lineJoin;
  globalAlpha = STATE.globalAlpha;
  font = STATE.font;
  textAlign = STATE.textAlign;
  textBaseline = STATE.textBaseline;
  imageSmoothingEnabled = true;
  private parts: string[] = [];
  private path = "";
  private dash: number[] = [];
  private open = 0; // groups opened since the last save
  private kept: State[] = [];
  private clips = 0;

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {}

  /** The file, with a title that screen readers speak. */
  text(title: string): string {
    const size = `width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}"`;
    const head = `<svg xmlns="http://www.w3.org/2000/svg" ${size} role="img"><title>${escaped(title)}</title>`;
    return `${head}\n${this.parts.join("\n")}\n</svg>\n`;
  }

  save(): void {
    const { dash, open } = this;
    const keys = Object.keys(STATE) as (keyof typeof STATE)[];
    const state = Object.fromEntries(keys.map((key) => [key, this[key]])) as typeof STATE;
    this.kept.push({ ...state, dash, open });
    this.open = 0;
  }

  restore(): void {
    this.parts.push("</g>".repeat(this.open));
    const kept = this.kept.pop();
    if (kept) Object.assign(this, kept);
  }

  beginPath(): void {
    this.path = "";
  }

  closePath(): void {
    this.path += "Z";
  }

  moveTo(x: number, y: number): void {
    this.path += `M${short(x)} ${short(y)}`;
  }

  lineTo(x: number, y: number): void {
    this.path += `${this.path ? "L" : "M"}${short(x)} ${short(y)}`;
  }

  rect(x: number, y: number, w: number, h: number): void {
    this.path += `M${short(x)} ${short(y)}h${short(w)}v${short(h)}h${short(-w)}Z`;
  }

  arc(x: number, y: number, r: number, from: number, to: number, backwards = false): void {
    const at = (angle: number) =>
      `${short(x + r * Math.cos(angle))} ${short(y + r * Math.sin(angle))}`;
    const sweep = backwards ? 0 : 1;
    const middle = (from + to) / 2;
    const radii = `${short(r)} ${short(r)} 0 0 ${sweep}`;
    this.path += `${this.path ? "L" : "M"}${at(from)}A${radii} ${at(middle)}A${radii} ${at(to)}`;
  }

  stroke(): void {
    const dash = this.dash.length ? ` stroke-dasharray="${this.dash.join(" ")}"` : "";
    const style = `stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linecap="${this.lineCap}" stroke-linejoin="${this.lineJoin}"`;
    this.parts.push(`<path d="${this.path}" fill="none" ${style}${dash}${this.alpha()}/>`);
  }

  fill(): void {
    this.parts.push(`<path d="${this.path}" fill="${this.fillStyle}"${this.alpha()}/>`);
  }

  fillRect(x: number, y: number, w: number, h: number): void {
    const box = `x="${short(x)}" y="${short(y)}" width="${short(w)}" height="${short(h)}"`;
    this.parts.push(`<rect ${box} fill="${this.fillStyle}"${this.alpha()}/>`);
  }

  fillText(text: string, x: number, y: number): void {
    const [, slant, weight, size, family] =
      /^(?:(italic) )?(?:(\d+|bold) )?([\d.]+)px (.+)$/.exec(this.font) ?? [];
    const style = `${slant ? ' font-style="italic"' : ""}${weight ? ` font-weight="${weight}"` : ""}`;
    const place = `text-anchor="${ANCHORS[this.textAlign] ?? "start"}" dominant-baseline="${BASELINES[this.textBaseline] ?? "auto"}"`;
    const font = `font-size="${size ?? 10}" font-family="${escaped(family ?? "sans-serif")}"${style}`;
    this.parts.push(
      `<text x="${short(x)}" y="${short(y)}" ${place} ${font} fill="${this.fillStyle}"${this.alpha()}>${escaped(text)}</text>`,
    );
  }

  drawImage(canvas: HTMLCanvasElement, x: number, y: number, w: number, h: number): void {
    const box = `x="${short(x)}" y="${short(y)}" width="${short(w)}" height="${short(h)}"`;
    const how = `preserveAspectRatio="none" image-rendering="pixelated"`;
    this.parts.push(`<image ${box} ${how} href="${canvas.toDataURL()}"/>`);
  }

  setLineDash(dash: Iterable<number>): void {
    this.dash = [...dash];
  }

  clip(): void {
    const name = `clip${++this.clips}`;
    this.parts.push(`<clipPath id="${name}"><path d="${this.path}"/></clipPath>`);
    this.group(`clip-path="url(#${name})"`);
  }

  translate(x: number, y: number): void {
    this.group(`transform="translate(${short(x)} ${short(y)})"`);
  }

  rotate(angle: number): void {
    this.group(`transform="rotate(${short((angle * 180) / Math.PI)})"`);
  }

  private group(attributes: string): void {
    this.parts.push(`<g ${attributes}>`);
    ++this.open;
  }

  private alpha(): string {
    return this.globalAlpha < 1 ? ` opacity="${short(this.globalAlpha)}"` : "";
  }
}

function short(value: number): string {
  return String(Math.round(value * 100) / 100);
}

function escaped(text: string): string {
  const named: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text.replace(/[&<>"]/g, (letter) => named[letter]);
}
