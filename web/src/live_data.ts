import { reportOf, type Body, type Curve, type Panel, type Report } from './data';
import type { Control, Scene, State } from './protocol';

/** Samples that are kept: two minutes at 30 Hz, and room until the older half is thrown away. */
export const MOST_SAMPLES = 7200;
const SPEEDS = ['forward u', 'left v', 'up w'];
const RATES = ['roll p', 'pitch q', 'yaw r'];

/** Columns of numbers that grow at the end, and lose their older half when they are full. */
export class Columns {
  private readonly store: Float64Array[];
  private count = 0;

  constructor(width: number) {
    this.store = Array.from({ length: width }, () => new Float64Array(MOST_SAMPLES));
  }

  push(row: readonly (number | null | undefined)[]): void {
    if (this.count === MOST_SAMPLES) {
      const kept = MOST_SAMPLES / 2;
      for (const column of this.store) column.copyWithin(0, kept);
      this.count = kept;
    }
    this.store.forEach((column, i) => { column[this.count] = row[i] ?? NaN; });
    ++this.count;
  }
  clear(): void {
    this.count = 0;
  }
  get length(): number {
    return this.count;
  }
  column(i: number): Float64Array {
    return this.store[i]?.subarray(0, this.count) ?? new Float64Array();
  }
}

/** What is kept of one body. */
class Track {
  readonly poses = new Columns(8);
  readonly values: Columns;

  constructor(
    readonly body: Body,
    readonly controls: readonly Control[],
  ) {
    this.values = new Columns(7 + 2 * controls.length);
    body.panels = body.craft ? this.panels() : [];
    this.show();
  }

  private panels(): Panel[] {
    const units = [...new Set(this.controls.map(({ unit }) => unit))];
    return [
      this.panel('Velocity in the axes of the craft', 'm/s', SPEEDS.map((label, i) => this.curve(label, 1 + i))),
      this.panel('Angular velocity in the axes of the craft', 'rad/s', RATES.map((label, i) => this.curve(label, 4 + i))),
      ...units.map((unit) => {
        const title = unit === 'N' ? 'Thrust' : unit === 'rad' ? 'Angle' : unit === '' ? 'Share of the nominal speed' : 'Speed';
        return this.panel(title, unit, this.controls.flatMap(({ name, unit: own }, i) => (own === unit
          ? [this.curve(name, 7 + i), this.curve(name, 7 + this.controls.length + i, true)] : [])));
      }),
    ];
  }
  private panel(title: string, unit: string, curves: (() => Curve)[]): Panel {
    return {
      title, unit, source: this.body.name, main: true, bands: [],
      times: () => this.values.column(0),
      curves: () => curves.map((curve) => curve()),
    };
  }
  private curve(label: string, at: number, demand = false): () => Curve {
    return () => ({ label, demand, values: this.values.column(at) });
  }

  push({ t, poses, motions, applied, demanded }: State, i: number): void {
    const pose = poses[i] ?? [];
    if (pose[0] === null || pose[0] === undefined) return; // not heard of yet
    this.poses.push([t, ...pose]);
    if (this.body.craft) this.values.push([t, ...(motions[i] ?? []), ...(applied[i] ?? []), ...(demanded[i] ?? [])]);
    this.show();
  }
  clear(): void {
    this.poses.clear();
    this.values.clear();
  }
  private show(): void {
    const { motion } = this.body;
    motion.times = this.poses.column(0);
    motion.position = [1, 2, 3].map((i) => this.poses.column(i));
    motion.orientation = [4, 5, 6, 7].map((i) => this.poses.column(i));
  }
}

/** A run as it comes in, in the form in which a recorded one is shown. */
export class LiveRun {
  readonly report: Report;
  readonly tracks: Track[];
  private episode = -1;
  private newest = -Infinity;

  constructor(scene: Scene) {
    this.report = reportOf(scene.report);
    this.tracks = (this.report.runs[0]?.bodies ?? []).map((body, i) => new Track(body, scene.controls[i] ?? []));
  }

  /** Keeps a state. @returns whether it is one of another episode, or of a time before: what was kept is forgotten. */
  take(state: State): boolean {
    const isNew = state.episode !== this.episode || state.t < this.newest;
    if (isNew) for (const track of this.tracks) track.clear();
    if (isNew || state.t > this.newest) this.tracks.forEach((track, i) => { track.push(state, i); });
    this.episode = state.episode;
    this.newest = state.t;
    return isNew;
  }
}
