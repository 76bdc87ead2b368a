const DELAY = 0.06; // s of wall time behind the newest state: between two of them there is a line to go along
const JUMP = 0.5; // s of wall time: what lies farther away is jumped to
const PULL = 4; // 1/s, how fast a difference is made up

/** The time that a live page shows: it goes on smoothly between states that come unevenly, and stands where they do. */
export class LiveClock {
  private newest = 0;
  private moment = 0;
  private began = false;

  /** A state has come. */
  take(time: number): void {
    if (!this.began || time < this.newest) this.moment = time; // it begins, or begins anew
    this.began = true;
    this.newest = time;
  }

  /** @param seconds of wall time that have passed. @param factor simulated per wall time. @returns the time to show. */
  advance(seconds: number, factor: number): number {
    const wanted = this.newest - DELAY * factor;
    const next = this.moment + seconds * factor;
    const away = wanted - next;
    const isFar = Math.abs(away) > JUMP * Math.max(factor, 0.1);
    const drawn = isFar ? wanted : next + away * Math.min(1, PULL * seconds);
    this.moment = Math.min(this.newest, Math.max(this.moment, drawn));
    return this.moment;
  }
}
