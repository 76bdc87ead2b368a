import assert from 'node:assert/strict';
import { test } from 'node:test';
import { nearestOf } from './nearest';

void test('the nearest of some times is found within a reach', () => {
  assert.equal(nearestOf([1, 2, 5], 2.2, 0.5), 2);
  assert.equal(nearestOf([2, 2.3, 1], 2.2, 0.5), 2.3);
  assert.equal(nearestOf([1, 2, 5], 3, 0.5), undefined);
  assert.equal(nearestOf([], 3, 0.5), undefined);
});
