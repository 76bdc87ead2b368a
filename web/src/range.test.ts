import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rangeOf } from './range';

test('values have some room around them', () => {
  const [least, most] = rangeOf(0, 10);
  assert.ok(Math.abs(least + 0.6) < 1e-12 && Math.abs(most - 10.6) < 1e-12);
});

test('one value, and one with the noise of rounding, lies in the middle of a range that can be labelled', () => {
  assert.deepEqual(rangeOf(2, 2), [1, 3]);
  const [least, most] = rangeOf(2 - 1e-13, 2 + 1e-13);
  assert.ok(most - least > 1);
  assert.deepEqual(rangeOf(0, 0), [-0.5, 0.5]);
  assert.deepEqual(rangeOf(-1e-14, 1e-14), [-0.5, 0.5]);
});

test('no value at all has a range too', () => {
  assert.deepEqual(rangeOf(null, null), [0, 1]);
  assert.deepEqual(rangeOf(NaN, Infinity), [0, 1]);
});
