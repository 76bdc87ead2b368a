import type { Motion, Quaternion, Vector } from './data';

export interface Pose {
  position: Vector;
  orientation: Quaternion;
}

/** The last index whose time is not after `time`; 0 before the first. */
export function indexAt(times: ArrayLike<number>, time: number): number {
  let low = 0;
  let high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/** Between two orientations, the shorter way, by their normalised mean: two samples lie near each other. */
function between(a: Quaternion, b: Quaternion, share: number): Quaternion {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  const mixed = a.map((value, i) => (1 - share) * value + sign * share * (b[i] ?? 0));
  const length = Math.hypot(...mixed) || 1;
  const [x = 0, y = 0, z = 0, w = 1] = mixed.map((value) => value / length);
  return [x, y, z, w];
}

function orientationAt(motion: Motion, i: number): Quaternion {
  const [x, y, z, w] = motion.orientation;
  return [x?.[i] ?? 0, y?.[i] ?? 0, z?.[i] ?? 0, w?.[i] ?? 1];
}

function positionAt(motion: Motion, i: number): Vector {
  const [x, y, z] = motion.position;
  return [x?.[i] ?? 0, y?.[i] ?? 0, z?.[i] ?? 0];
}

/** Where a body is at a time: between two samples in between, before the first and after the last there. */
export function poseAt(motion: Motion, time: number): Pose {
  const { times } = motion;
  const i = indexAt(times, time);
  const begin = times[i];
  const end = times[i + 1];
  const share = end !== undefined && end > begin ? Math.min(1, Math.max(0, (time - begin) / (end - begin))) : 0;
  if (share === 0) return { position: positionAt(motion, i), orientation: orientationAt(motion, i) };
  const a = positionAt(motion, i);
  const b = positionAt(motion, i + 1);
  return {
    position: [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])],
    orientation: between(orientationAt(motion, i), orientationAt(motion, i + 1), share),
  };
}

/** q v q*. */
export function rotate([x, y, z, w]: Quaternion, [a, b, c]: Vector): Vector {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** The heading in rad: of the x axis of the body, seen from above. */
export function headingOf(orientation: Quaternion): number {
  const [x, y] = rotate(orientation, [1, 0, 0]);
  return Math.atan2(y, x);
}
