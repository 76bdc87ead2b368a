/** The time that everything on the page shows, and how it goes on. */
export class Player {
  private moment = 0;
  private hovered: number | undefined;
  private readonly listeners: ((time: number) => void)[] = [];
  private readonly changes: (() => void)[] = [];
  playing = false;
  speed = 1;

  /** @param end of the run, s; of a live one it moves. */
  constructor(public end: number) {}

  /** Calls `listener` whenever another time is shown. */
  onTime(listener: (time: number) => void): void {
    this.listeners.push(listener);
  }
  /** Calls `listener` when it starts, stops or gets another speed. */
  onChange(listener: () => void): void {
    this.changes.push(listener);
  }

  /** What is shown: where a pointer is on a plot, else where the playing is. */
  get shown(): number {
    return this.hovered ?? this.moment;
  }
  get time(): number {
    return this.moment;
  }

  seek(time: number): void {
    this.moment = Math.min(this.end, Math.max(0, time));
    this.tell();
  }

  /** A pointer is on a plot at this time, or on none any more. While it plays nobody is interrupted. */
  hover(time: number | undefined): void {
    const next = this.playing || time === undefined ? undefined : Math.min(this.end, Math.max(0, time));
    if (next === this.hovered) return;
    this.hovered = next;
    this.tell();
  }

  toggle(): void {
    this.playing = !this.playing;
    this.hovered = undefined;
    if (this.playing && this.moment >= this.end) this.moment = 0;
    this.tell();
    for (const listener of this.changes) listener();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    for (const listener of this.changes) listener();
  }

  /** So many seconds of the viewer have gone by. At the end it stops. */
  advance(seconds: number): void {
    if (!this.playing) return;
    this.moment = Math.min(this.end, this.moment + seconds * this.speed);
    this.tell();
    if (this.moment >= this.end) this.toggle();
  }

  private tell(): void {
    for (const listener of this.listeners) listener(this.shown);
  }
}
