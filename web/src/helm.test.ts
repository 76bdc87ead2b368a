import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drivingKey, levelsOf, wishOfKeys, wishOfPads } from './helm';
import type { Control } from './protocol';

function control(name: string, part: Partial<Control>): Control {
  return { name, unit: 'N', least: 0, most: 2, rest: 0, holds: false, ahead: 0, turn: 0, ...part };
}
const CRAFT = [control('rear', { most: 4.5, ahead: 1 }), control('left', { turn: -1 }), control('right', { turn: 1 })];

test('a turn to the left is made by the engine that turns left, and no engine pushes backwards that cannot', () => {
  assert.deepEqual(levelsOf(CRAFT, { ahead: 1, turn: 0.5 }), { rear: 4.5, left: 0, right: 1 });
  assert.deepEqual(levelsOf(CRAFT, { ahead: -1, turn: -1 }), { rear: 0, left: 2, right: 0 });
});

test('two screws abreast are mixed, within their limits', () => {
  const screws = [control('port', { least: -1, ahead: 1, turn: -1 }), control('starboard', { least: -1, ahead: 1, turn: 1 })];
  assert.deepEqual(levelsOf(screws, { ahead: 0.5, turn: 1 }), { port: -0.5, starboard: 2 });
  assert.deepEqual(levelsOf(screws, { ahead: 1, turn: 1 }), { port: 0, starboard: 2 });
});

test('a rudder turns the other way, and a lift fan is left alone', () => {
  const craft = [control('rudder', { unit: 'rad', least: -0.5, most: 0.5, turn: -1, holds: true }), control('lift', { most: 1, holds: true })];
  assert.deepEqual(levelsOf(craft, { ahead: 1, turn: 1 }), { rudder: -0.5 });
});

test('keys add up, and opposite ones cancel', () => {
  assert.deepEqual(wishOfKeys(new Set(['w', 'ArrowLeft'])), { ahead: 1, turn: 1 });
  assert.deepEqual(wishOfKeys(new Set(['w', 'ArrowUp', 'a', 'd'])), { ahead: 1, turn: 0 });
  assert.equal(drivingKey('W'), 'w');
  assert.equal(drivingKey('ArrowUp'), 'ArrowUp');
  assert.equal(drivingKey('x'), undefined);
  assert.equal(drivingKey('constructor'), undefined);
});

test('a gamepad drives only while a shoulder button is held, and a stick at rest asks for nothing', () => {
  const pad = (held: boolean, ...axes: number[]) => ({
    connected: true, axes, buttons: Array.from({ length: 8 }, (_, i) => ({ pressed: held && i === 5, touched: false, value: 0 })),
  });
  assert.equal(wishOfPads([null, pad(false, 0, -1, 0, 0)]), undefined);
  assert.deepEqual(wishOfPads([null, pad(true, 0, -1, 0.1, 0)]), { ahead: 1, turn: 0 });
  assert.deepEqual(wishOfPads([pad(true, 0, 0.05, 1, 0)]), { ahead: 0, turn: -1 });
  assert.deepEqual(wishOfPads([pad(true)]), { ahead: 0, turn: 0 });
  assert.deepEqual(wishOfPads([pad(true, 0, NaN, NaN)]), { ahead: 0, turn: 0 });
  assert.equal(wishOfPads([{ ...pad(true, 0, -1), connected: false }]), undefined);
});
