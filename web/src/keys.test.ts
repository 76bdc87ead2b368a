import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Contact } from './data';
import { actionOf, neighbour } from './keys';
import { Player } from './player';

function contact(time: number): Contact {
  return { time, kind: 'bounce', a: 'craft', b: 'wall', point: [0, 0, 0], normal: [1, 0, 0], impulse: [1, 0, 0] };
}

function press(player: Player, key: string, isFast = false, contacts: Contact[] = []): number[] {
  const speeds: number[] = [];
  actionOf(key, isFast, player, { change: (step) => { speeds.push(step); } }, contacts)?.();
  return speeds;
}

test('arrows step, with shift farther, Home and End go to the ends', () => {
  const player = new Player(10);
  press(player, 'ArrowRight', true);
  press(player, 'ArrowRight');
  assert.ok(Math.abs(player.time - 1.1) < 1e-12);
  press(player, 'ArrowLeft', true);
  assert.ok(Math.abs(player.time - 0.1) < 1e-12);
  press(player, 'End');
  assert.equal(player.time, 10);
  press(player, 'Home');
  assert.equal(player.time, 0);
});

test('space plays and pauses, plus and minus change the speed', () => {
  const player = new Player(10);
  press(player, ' ');
  assert.equal(player.playing, true);
  press(player, ' ');
  assert.equal(player.playing, false);
  assert.deepEqual(press(player, '+'), [1]);
  assert.deepEqual(press(player, '-'), [-1]);
});

test('n and p go from contact to contact, and stay at the last', () => {
  const contacts = [contact(2), contact(5)];
  const player = new Player(10);
  for (const expected of [2, 5, 5]) {
    press(player, 'n', false, contacts);
    assert.equal(player.time, expected);
  }
  press(player, 'p', false, contacts);
  assert.equal(player.time, 2);
  assert.equal(neighbour(contacts, 2, false), undefined);
});

test('another key has no meaning', () => {
  assert.equal(actionOf('x', false, new Player(1), { change: () => undefined }, []), undefined);
});
