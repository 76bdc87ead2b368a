import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Panel } from './data';
import { resample, tableOf } from './overlay';

function panel(times: number[], values: number[], demand = false): Panel {
  return {
    title: 'Thrust',
    source: '/craft/engines',
    unit: 'N',
    main: true,
    bands: [],
    times: () => Float64Array.from(times),
    curves: () => [{ label: 'rear', demand, values: Float64Array.from(values) }],
  };
}

test('one run alone keeps its samples, gaps are null', () => {
  const table = tableOf(panel([0, 1, 2], [5, NaN, 7]), undefined);
  assert.deepEqual([...table.times], [0, 1, 2]);
  assert.deepEqual(Array.from(table.curves[0]?.values ?? []), [5, null, 7]);
});

test('two runs of the same times share them', () => {
  const table = tableOf(panel([0, 1], [1, 2]), panel([0, 1], [3, 4]));
  assert.equal(table.times.length, 2);
  assert.deepEqual(table.curves.map(({ isOther, values }) => [isOther, ...Array.from(values)]), [[false, 1, 2], [true, 3, 4]]);
});

test('two runs of other times have all of both, and nothing beyond their ends', () => {
  const table = tableOf(panel([0, 2], [0, 4]), panel([1, 3], [10, 20]));
  assert.deepEqual([...table.times], [0, 1, 2, 3]);
  assert.deepEqual(Array.from(table.curves[0]?.values ?? []), [0, 2, 4, null]);
  assert.deepEqual(Array.from(table.curves[1]?.values ?? []), [null, 10, 15, 20]);
});

test('a demand holds until the next one', () => {
  const [curve] = panel([0, 2], [1, 3], true).curves();
  assert.ok(curve);
  assert.deepEqual(resample(curve, Float64Array.of(0, 2), Float64Array.of(0, 1.9, 2)), [1, 1, 3]);
});
