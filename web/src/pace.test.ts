import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pace } from './pace';

function timesIn(pace: Pace, seconds: number): number {
  let times = 0;
  for (let i = 0; i < 100; ++i) {
    pace.next(seconds);
    if (pace.hasTime) ++times;
  }
  return times;
}

test('where frames come at 60 Hz every one has time for all', () => {
  assert.equal(timesIn(new Pace(), 1 / 60), 100);
});

test('where they are slow one in four has, and all of them again when they are fast', () => {
  const pace = new Pace();
  timesIn(pace, 0.05);
  assert.equal(timesIn(pace, 0.05), 25);
  timesIn(pace, 1 / 60);
  assert.equal(timesIn(pace, 1 / 60), 100);
});
