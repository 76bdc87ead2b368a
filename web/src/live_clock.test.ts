import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LiveClock } from './live_clock';

test('the time shown never goes back nor beyond the newest state, and follows it closely', () => {
  const clock = new LiveClock();
  clock.take(0);
  let shown = 0;
  for (let i = 1; i <= 300; ++i) {
    // States come in pairs, late by turns.
    if (i % 2 === 0) clock.take(i / 60 - (i % 4 === 0 ? 0.02 : 0));
    const next = clock.advance(1 / 60, 1);
    assert.ok(next >= shown && next <= i / 60, `${next} after ${shown}`);
    if (i > 60) assert.ok(i / 60 - next < 0.15, `${i / 60 - next} s behind`);
    shown = next;
  }
});

test('a paused run is shown where it stands, a reset one from its start, a fast one near its end', () => {
  const clock = new LiveClock();
  clock.take(5);
  for (let i = 0; i < 60; ++i) clock.advance(1 / 60, 1);
  assert.equal(clock.advance(1 / 60, 1), 5);
  clock.take(0.1);
  assert.ok(clock.advance(1 / 60, 1) <= 0.1);
  clock.take(100);
  assert.ok(Math.abs(clock.advance(1 / 60, 10) - 99.4) < 1e-9);
});
