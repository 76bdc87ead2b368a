const SMOOTHING = 0.1; // share of the newest frame in the mean
const SLOW_SECONDS = 0.025; // a frame that takes longer is seen to stutter
const SLOW_SHARE = 4; // every so many frames what is less looked at is drawn, where frames are slow

/** Says when the parts of a page are drawn, so that where frames are slow (no graphics hardware) the view in three dimensions goes on. */
export class Pace {
  private mean = 0;
  private frame = 0;

  /** @param seconds since the frame before. */
  next(seconds: number): void {
    this.mean += SMOOTHING * (Math.min(seconds, 0.5) - this.mean);
    ++this.frame;
  }

  /** Whether this frame has time for all parts. */
  get hasTime(): boolean {
    return this.mean < SLOW_SECONDS || this.frame % SLOW_SHARE === 0;
  }
}
