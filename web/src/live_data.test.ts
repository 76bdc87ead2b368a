import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Columns, LiveRun, MOST_SAMPLES } from './live_data';
import type { Scene, State } from './protocol';

const CONTROL = { name: 'rear', unit: 'N', least: 0, most: 4, rest: 0, holds: false, ahead: 1, turn: 0 };
const EMPTY: [number, number, number, number] = [0, 0, 0, 1];

function scene(): Scene {
  const body = { name: 'red', craft: true, shapes: [], engines: [], motion: { source: '', t: EMPTY, p: [EMPTY, EMPTY, EMPTY], q: [EMPTY, EMPTY, EMPTY, EMPTY] }, panels: [] };
  const run = { source: '', end: 0, bodies: [body], obstacles: [], contacts: [], manoeuvres: [], panels: [], marks: [], facts: [], notes: [], scenario: '' };
  return { type: 'scene', controls: [[CONTROL]], report: { format: 1, runs: [run], comparison: [], stride: 1, numbers: '' } };
}

function state(t: number, x: number | null, episode = 0): State {
  return { type: 'state', t, tick: 0, episode, poses: [[x, 2, 3, 0, 0, 0, 1]], motions: [[1, 0, 0, 0, 0, 0.5]], applied: [[2]], demanded: [[null]] };
}

test('columns keep their newer half when they are full', () => {
  const columns = new Columns(2);
  for (let i = 0; i <= MOST_SAMPLES; ++i) columns.push([i, null]);
  assert.equal(columns.length, MOST_SAMPLES / 2 + 1);
  assert.equal(columns.column(0)[0], MOST_SAMPLES / 2);
  assert.equal(columns.column(0).at(-1), MOST_SAMPLES);
  assert.ok(Number.isNaN(columns.column(1).at(-1)));
});

test('states become motion and curves of the body; one that was not heard of is left out', () => {
  const run = new LiveRun(scene());
  const body = run.report.runs[0]?.bodies[0];
  assert.ok(body);
  run.take(state(0.1, null));
  assert.equal(body.motion.times.length, 0);
  run.take(state(0.2, 7));
  run.take(state(0.2, 8)); // the same again: a viewer that has just come is told it twice
  run.take(state(0.3, 9));
  assert.deepEqual([...body.motion.times], [0.2, 0.3]);
  assert.deepEqual([...(body.motion.position[0] ?? [])], [7, 9]);
  const thrust = body.panels.find(({ unit }) => unit === 'N');
  assert.deepEqual([...(thrust?.curves()[0]?.values ?? [])], [2, 2]);
  assert.ok(thrust?.curves()[1]?.demand);
});

test('another episode, and a time that goes back, begin anew', () => {
  const run = new LiveRun(scene());
  assert.ok(run.take(state(5, 1)));
  assert.ok(!run.take(state(6, 1)));
  assert.ok(run.take(state(7, 1, 1)));
  assert.ok(run.take(state(3, 1, 1)));
  assert.equal(run.report.runs[0]?.bodies[0]?.motion.times.length, 1);
});
