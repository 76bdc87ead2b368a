import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Ground } from './data';
import { levelShade, reliefOf, shadesOf } from './relief';

function ground(heights: number[]): Ground {
  return { height: 0, normal: [0, 0, 1], columns: 3, spacing: 0.5, x: -1, y: 2, heights: Float64Array.from(heights) };
}

test('a grid of 3 by 2 heights has six corners and four triangles', () => {
  const { corners, triangles } = reliefOf(ground([1, 2, 3, 4, 5, 6]));
  assert.deepEqual([...corners.slice(0, 3)], [-1, 2, 1]);
  assert.deepEqual([...corners.slice(15)], [0, 2.5, 6]);
  assert.equal(triangles.length, 12);
  assert.ok(triangles.every((corner) => corner < 6));
});

test('a plane has none', () => {
  assert.equal(reliefOf({ ...ground([]), columns: 0 }).triangles.length, 0);
});

test('a slope that faces the light is brighter than one that turns away', () => {
  const [up = 0] = shadesOf(ground([0, 1, 2, 0, 1, 2]));
  const [level = 0] = shadesOf(ground([0, 0, 0, 0, 0, 0]));
  assert.equal(level, Math.round(255 * levelShade));
  const [down = 0] = shadesOf(ground([2, 1, 0, 2, 1, 0]));
  assert.ok(up > level && level > down, `${up} ${level} ${down}`);
});
