import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Motion } from './data';
import { headingOf, indexAt, poseAt, rotate } from './motion';

const half = Math.SQRT1_2;

function motion(): Motion {
  return {
    source: 'test',
    times: new Float64Array([0, 1, 3]),
    position: [new Float64Array([0, 2, 2]), new Float64Array([0, 0, 4]), new Float64Array(3)],
    // No turn; 90 degrees about z; the same with the other sign.
    orientation: [
      new Float64Array(3),
      new Float64Array(3),
      new Float64Array([0, half, -half]),
      new Float64Array([1, half, -half]),
    ],
  };
}

test('the index is that of the last sample that is not later', () => {
  const times = [0, 1, 3];
  assert.deepEqual([-1, 0, 0.5, 1, 2.9, 3, 9].map((time) => indexAt(times, time)), [0, 0, 0, 1, 1, 2, 2]);
  assert.equal(indexAt([], 1), 0);
});

test('between two samples a body is between, before and after them it stands', () => {
  assert.deepEqual(poseAt(motion(), -5).position, [0, 0, 0]);
  assert.deepEqual(poseAt(motion(), 0.25).position, [0.5, 0, 0]);
  assert.deepEqual(poseAt(motion(), 2).position, [2, 2, 0]);
  assert.deepEqual(poseAt(motion(), 99).position, [2, 4, 0]);
});

test('an orientation goes the shorter way, whatever its sign', () => {
  assert.ok(Math.abs(headingOf(poseAt(motion(), 0.5).orientation) - Math.PI / 4) < 1e-12);
  assert.ok(Math.abs(headingOf(poseAt(motion(), 2).orientation) - Math.PI / 2) < 1e-12);
});

test('a rotation about z by 90 degrees takes x to y', () => {
  const [x, y, z] = rotate([0, 0, half, half], [1, 0, 0]);
  assert.ok(Math.hypot(x, y - 1, z) < 1e-12);
});
