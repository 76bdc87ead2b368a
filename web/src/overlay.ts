import type { Curve, Panel } from './data';
import { indexAt } from './motion';

/** A panel as plots want it: times, then one list of values a curve; a gap is null. */
export interface Table {
  times: Float64Array;
  curves: { label: string; demand: boolean; isOther: boolean; values: ArrayLike<number | null> }[];
}

function withGaps(values: Float64Array): ArrayLike<number | null> {
  return values.some(Number.isNaN) ? Array.from(values, (value) => (Number.isNaN(value) ? null : value)) : values;
}

function areEqual(a: Float64Array, b: Float64Array): boolean {
  return a.length === b.length && a.every((value, i) => Math.abs(value - b[i]) < 5e-10);
}

/** All times of both, in order, each once. */
function unionOf(a: Float64Array, b: Float64Array): Float64Array {
  const sorted = Float64Array.from([...a, ...b]).sort();
  return sorted.filter((time, i) => i === 0 || time !== sorted[i - 1]);
}

/** The values of a curve at other times: the line between its samples; nothing outside of them. A demand holds until the next one. */
export function resample({ demand, values }: Curve, from: Float64Array, to: Float64Array): (number | null)[] {
  const first = from[0] ?? Infinity;
  const last = from[from.length - 1] ?? -Infinity;
  return Array.from(to, (time) => {
    if (time < first || time > last) return null;
    const i = indexAt(from, time);
    const begin = from[i];
    const end = from[i + 1];
    const share = end !== undefined && end > begin ? (time - begin) / (end - begin) : 0;
    const value = demand || share === 0 ? values[i] : values[i] + share * (values[i + 1] - values[i]);
    return Number.isNaN(value) ? null : value;
  });
}

/** The curves of a panel, and, where another run has the same panel, those of that too. */
export function tableOf(panel: Panel, other: Panel | undefined): Table {
  const times = panel.times();
  const own = panel.curves().map((curve) => ({ ...curve, isOther: false }));
  if (!other) return { times, curves: own.map((curve) => ({ ...curve, values: withGaps(curve.values) })) };
  const otherTimes = other.times();
  const others = other.curves().map((curve) => ({ ...curve, isOther: true }));
  if (areEqual(times, otherTimes)) {
    return { times, curves: [...own, ...others].map((curve) => ({ ...curve, values: withGaps(curve.values) })) };
  }
  const union = unionOf(times, otherTimes);
  return {
    times: union,
    curves: [
      ...own.map((curve) => ({ ...curve, values: resample(curve, times, union) })),
      ...others.map((curve) => ({ ...curve, values: resample(curve, otherTimes, union) })),
    ],
  };
}
