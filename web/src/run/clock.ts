// The clock of the stage. It stands on places of the grid t0 + n h and nowhere between: at whatever
// frame rate, at any speed, after a pause, a step or a hidden tab, the state at a place is the same.

/** What the clock tells after a while. */
export interface Ticked {
  place: number;
  /** Whether it had to wait for places that are not computed yet. */
  waits: boolean;
  /** Whether it stands at the last place. */
  ended: boolean;
}

/** Counts places of a grid while a person's clock runs. */
export class Clock {
  place = 0;
  playing = false;
  speed = 1; // seconds of the motion in a second
  private since = 0; // ms of the person's clock since the place `from`
  private from = 0;

  /**
   * @param spacing of the grid [s]; negative where time runs back.
   * @param last place.
   */
  constructor(
    public spacing = 0.005,
    public last = 0,
  ) {}

  /** Plays from where it stands; from the start where it stands at the end. */
  play(): void {
    if (this.place >= this.last) this.place = 0;
    this.playing = true;
    this.anchor();
  }

  pause(): void {
    this.playing = false;
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.anchor();
  }

  /** Stands at a place. */
  go(place: number): void {
    this.place = Math.min(Math.max(0, Math.round(place)), this.last);
    this.anchor();
  }

  /** Another grid begins at its start. */
  restart(spacing: number, last: number): void {
    this.spacing = spacing;
    this.last = last;
    this.go(0);
  }

  /**
   * Some time of the person's clock went by.
   * @param ms of it.
   * @param computed so many places are there.
   */
  tick(ms: number, computed: number): Ticked {
    if (!this.playing) return { place: this.place, waits: false, ended: false };
    this.since += ms;
    const wanted =
      this.from + Math.floor((this.since / 1000) * (this.speed / Math.abs(this.spacing)) + 1e-9);
    const reached = Math.max(0, Math.min(computed, this.last + 1) - 1);
    this.place = Math.max(this.place, Math.min(wanted, reached));
    const ended = this.place >= this.last;
    const waits = wanted > reached && !ended;
    if (waits) this.anchor(); // what could not be shown in time is not made up for
    if (ended) this.playing = false;
    return { place: this.place, waits, ended };
  }

  private anchor(): void {
    this.from = this.place;
    this.since = 0;
  }
}
