import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Shape } from './data';
import { cornersOf, outlineOf } from './outline';

function box(size: [number, number, number]): Shape {
  return { kind: 'box', role: 'hull', size, position: [1, 0, 0], orientation: [0, 0, Math.SQRT1_2, Math.SQRT1_2] };
}

test('a box has eight corners, turned and shifted', () => {
  const corners = cornersOf([box([2, 4, 6])]);
  assert.equal(corners.length, 8);
  const xs = corners.map(([x]) => x);
  // Turned by 90 degrees: 4 m along x now, about x = 1.
  assert.ok(Math.abs(Math.min(...xs) + 1) < 1e-12 && Math.abs(Math.max(...xs) - 3) < 1e-12);
});

test('the outline of a box is its four edges, whatever lies inside', () => {
  const outline = outlineOf([...cornersOf([box([2, 4, 6])]), [1, 0, 0]]);
  assert.equal(outline.length, 4);
  const area = outline.reduce((sum, [x, y], i) => {
    const [u = 0, v = 0] = outline[(i + 1) % outline.length] ?? [];
    return sum + (x * v - u * y) / 2;
  }, 0);
  assert.ok(Math.abs(area - 8) < 1e-9);
});

test('no points have no outline, one is itself', () => {
  assert.deepEqual(outlineOf([]), []);
  assert.deepEqual(outlineOf([[1, 2, 3]]), [[1, 2]]);
});
