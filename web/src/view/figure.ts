// A drawing on the page: a canvas with a title, a text that says what it shows, and the same picture
// as a file.

import { el, fresh } from "../controls/dom";
import { type Surface, SvgSurface } from "./svg";
import { theme } from "./theme";

/** How a figure draws itself into a rectangle [CSS pixels]. */
export type Draw = (surface: Surface, width: number, height: number) => void;

export class Figure {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  private readonly text: HTMLElement;
  private width = 0;
  private height = 0;

  /**
   * @param title of the figure, shown above it.
   * @param draw its picture.
   * @param describe what it shows now, in a sentence.
   */
  constructor(
    readonly title: string,
    private readonly draw: Draw,
    private readonly describe: () => string,
    className = "",
  ) {
    const id = fresh("text");
    this.canvas = el("canvas", { role: "img", "aria-label": title, "aria-describedby": id });
    this.text = el("p", { id, class: "unseen" });
    const caption = title ? el("figcaption", {}, title) : null;
    this.element = el("figure", { class: className }, caption, this.canvas, this.text);
  }

  /** Draws the picture as it is now. */
  render(): void {
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 3);
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (width === 0 || height === 0) return;
    if (
      canvas.width !== Math.round(width * ratio) ||
      canvas.height !== Math.round(height * ratio)
    ) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.width = width;
    this.height = height;
    const context = canvas.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    this.draw(context, width, height);
  }

  /** Renews the text for those who do not see the picture. */
  tell(): void {
    const text = this.describe();
    if (this.text.textContent !== text) this.text.textContent = text;
  }

  /** The picture as an SVG file. */
  svg(): string {
    const surface = new SvgSurface(this.width || 640, this.height || 400);
    surface.fillStyle = theme().paper;
    surface.fillRect(0, 0, this.width || 640, this.height || 400);
    this.draw(surface, this.width || 640, this.height || 400);
    return surface.text(`${this.title}. ${this.describe()}`);
  }

  /** The picture as a PNG file, with a ground. */
  png(): Promise<Blob> {
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    const context = copy.getContext("2d")!;
    context.fillStyle = theme().paper;
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(this.canvas, 0, 0);
    return new Promise((done, fail) =>
      copy.toBlob((blob) => (blob ? done(blob) : fail(new Error("PNG"))), "image/png"),
    );
  }
}
