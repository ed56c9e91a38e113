// A drawing on the page: a canvas with a title, a text that says what it shows, and the same picture
// as SVG.

import { el, fresh } from "../controls/dom";
import { type Surface, SvgSurface } from "./svg";

/** How a figure draws itself into a rectangle [CSS pixels]. */
export type Draw = (surface: Surface, width: number, height: number) => void;

/** What does not change from frame to frame; drawn again when its key is another. */
export interface Still {
  key: () => string;
  draw: Draw;
}

export class Figure {
  private readonly ground = document.createElement("canvas");
  private groundKey = "";
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  private readonly text: HTMLElement;
  private width = 0;
  private height = 0;

  /**
   * @param title of the figure, shown above it.
   * @param draw its picture.
   * @param describe what it shows now, in a sentence.
   * @param className of the element.
   * @param still what is drawn below, and seldom changes.
   */
  constructor(
    readonly title: string,
    private readonly draw: Draw,
    private readonly describe: () => string,
    className = "",
    private readonly still?: Still,
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
    if (this.still) this.layGround(this.still, context, ratio);
    this.draw(context, width, height);
  }

  /** Draws what stands still, from a copy where nothing of it has changed. */
  private layGround(still: Still, context: CanvasRenderingContext2D, ratio: number): void {
    const { ground, canvas } = this;
    const key = [
      still.key(),
      canvas.width,
      canvas.height,
      document.documentElement.dataset.theme,
    ].join();
    if (key !== this.groundKey) {
      this.groundKey = key;
      ground.width = canvas.width;
      ground.height = canvas.height;
      const own = ground.getContext("2d")!;
      own.setTransform(ratio, 0, 0, ratio, 0, 0);
      still.draw(own, this.width, this.height);
    }
    context.drawImage(ground, 0, 0, this.width, this.height);
  }

  /** Renews the text for those who do not see the picture. */
  tell(): void {
    const text = this.describe();
    if (this.text.textContent !== text) this.text.textContent = text;
  }

  /** Width and height [CSS pixels]. */
  get size(): [number, number] {
    return [this.width || 640, this.height || 400];
  }

  /** The picture as an SVG file. */
  svg(): string {
    const surface = new SvgSurface(...this.size);
    this.still?.draw(surface, ...this.size);
    this.draw(surface, ...this.size);
    return surface.text(`${this.title} ${this.describe()}`.trim());
  }
}
