import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawSteps } from './steps';

function drawn(times: number[], values: (number | null)[], scale = 10): string[] {
  const made: string[] = [];
  const pen = {
    moveTo: (x: number, y: number) => { made.push(`M${x},${y}`); },
    lineTo: (x: number, y: number) => { made.push(`L${x},${y}`); },
  };
  drawSteps(pen, times, values, { first: 0, last: times.length - 1, x: (time) => time * scale, y: (value) => value });
  return made;
}

test('a value holds until the next one', () => {
  assert.deepEqual(drawn([0, 1, 2, 3], [5, 5, 7, 7]), ['M0,5', 'L20,5', 'L20,5', 'L20,7', 'L20,7', 'L30,7']);
});

test('a gap ends the line, and the next value begins another', () => {
  assert.deepEqual(drawn([0, 1, 2], [5, null, 6]), ['M0,5', 'L10,5', 'M20,6', 'L20,6']);
});

test('many changes in a column of pixels are one upright line over all of them', () => {
  const count = 60000;
  const times = Array.from({ length: count }, (_, i) => i / count);
  const values = times.map((_, i) => (i % 7 === 3 ? 9 : i % 2));
  const made = drawn(times, values, 100);
  assert.ok(made.length <= 101 * 4 + 2, `${made.length} corners`);
  assert.ok(made.includes('L50,9') && made.includes('L50,0'));
});
