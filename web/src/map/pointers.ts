// Mouse, pen and fingers over the map: one moves or clicks, two pinch, the wheel zooms.

/** What is done with them; places are pixels of the canvas. */
export interface Hands {
  zoom: (factor: number, x: number, y: number) => void;
  move: (dx: number, dy: number) => void;
  click: (x: number, y: number) => void;
  over: (x: number, y: number) => void;
}

const CLICK = 5; // px: what moves less was a click

export class Pointers {
  private readonly down = new Map<number, { x: number; y: number }>();
  private moved = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly hands: Hands,
  ) {
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    canvas.addEventListener("pointerup", (event) => this.lift(event, true));
    canvas.addEventListener("pointercancel", (event) => this.lift(event, false));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  private at(event: MouseEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private press(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    if (this.down.size === 0) this.moved = 0;
    this.down.set(event.pointerId, this.at(event));
  }

  private drag(event: PointerEvent): void {
    const now = this.at(event);
    const before = this.down.get(event.pointerId);
    if (!before) {
      this.hands.over(now.x, now.y);
      return;
    }
    const others = [...this.down].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.down.set(event.pointerId, now);
    this.moved += Math.hypot(now.x - before.x, now.y - before.y);
    if (others.length === 0) {
      if (this.moved > CLICK) this.hands.move(now.x - before.x, now.y - before.y);
      return;
    }
    const [other] = others;
    const was = Math.hypot(before.x - other.x, before.y - other.y);
    const is = Math.hypot(now.x - other.x, now.y - other.y);
    if (was > 0 && is > 0) this.hands.zoom(was / is, (now.x + other.x) / 2, (now.y + other.y) / 2);
  }

  private lift(event: PointerEvent, whole: boolean): void {
    const alone = this.down.size === 1;
    this.down.delete(event.pointerId);
    if (!whole || !alone || this.moved > CLICK) return;
    const { x, y } = this.at(event);
    this.hands.click(x, y);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { x, y } = this.at(event);
    this.hands.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300))), x, y);
  }
}
