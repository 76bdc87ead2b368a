import type { Quaternion, Shape, Vector } from './data';
import { rotate } from './motion';

const ROUND_SIDES = 24;

function ring(radius: number, z: number): Vector[] {
  return Array.from({ length: ROUND_SIDES }, (_, i): Vector => {
    const angle = (2 * Math.PI * i) / ROUND_SIDES;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z];
  });
}

/** Points that a shape lies between, in its own frame, m. */
function pointsOf(shape: Shape): Vector[] {
  const [a, b, c] = shape.size;
  switch (shape.kind) {
    case 'box':
      return [-0.5, 0.5].flatMap((x) => [-0.5, 0.5].flatMap((y) => [-0.5, 0.5].map((z): Vector => [a * x, b * y, c * z])));
    case 'cylinder':
      return [...ring(a, -b / 2), ...ring(a, b / 2)];
    case 'cone':
      return [...ring(a, -b / 2), [0, 0, b / 2]];
    case 'sphere':
      return [...ring(a, 0), [0, 0, -a], [0, 0, a]];
    case 'faces':
      return shape.vertices ?? [];
  }
}

export function place([x, y, z]: Vector, position: Vector, orientation: Quaternion): Vector {
  const [a, b, c] = rotate(orientation, [x, y, z]);
  return [a + position[0], b + position[1], c + position[2]];
}

/** The corners of shapes in the frame that they are placed in. */
export function cornersOf(shapes: readonly Shape[]): Vector[] {
  return shapes.flatMap((shape) => pointsOf(shape).map((point) => place(point, shape.position, shape.orientation)));
}

/** The convex outline of points seen from above, counter-clockwise (Andrew 1979). */
export function outlineOf(points: readonly Vector[]): [number, number][] {
  const sorted = points.map(([x, y]): [number, number] => [x, y]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (inOrder: [number, number][]): [number, number][] => {
    const chain: [number, number][] = [];
    for (const point of inOrder) {
      for (;;) {
        const last = chain.at(-1);
        const before = chain.at(-2);
        if (!last || !before) break;
        const turn = (last[0] - before[0]) * (point[1] - before[1]) - (last[1] - before[1]) * (point[0] - before[0]);
        if (turn > 0) break;
        chain.pop();
      }
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  if (sorted.length < 2) return sorted;
  return [...half(sorted), ...half([...sorted].reverse())];
}
