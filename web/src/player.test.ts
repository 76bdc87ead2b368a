import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Player } from './player';

test('it plays at its speed, stops at the end, and begins again from there', () => {
  const player = new Player(10);
  const heard: number[] = [];
  player.onTime((time) => heard.push(time));
  player.setSpeed(4);
  player.advance(1);
  assert.equal(player.time, 0, 'it stands until it is started');
  player.toggle();
  player.advance(1);
  assert.equal(player.time, 4);
  player.advance(5);
  assert.equal(player.time, 10);
  assert.equal(player.playing, false);
  player.toggle();
  assert.equal(player.time, 0);
  assert.deepEqual(heard, [0, 4, 10, 10, 0]);
});

test('a pointer shows another time without moving the run, but not while it plays', () => {
  const player = new Player(10);
  player.seek(3);
  player.hover(7);
  assert.equal(player.shown, 7);
  assert.equal(player.time, 3);
  player.hover(undefined);
  assert.equal(player.shown, 3);
  player.toggle();
  player.hover(7);
  assert.equal(player.shown, 3);
});

test('no time is outside the run', () => {
  const player = new Player(10);
  player.seek(-1);
  assert.equal(player.time, 0);
  player.seek(99);
  assert.equal(player.time, 10);
  player.hover(-4);
  assert.equal(player.shown, 0);
});
