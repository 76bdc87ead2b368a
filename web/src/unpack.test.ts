import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bytesOf, unpackCurve, unpackTimes } from './unpack';

test('a curve is its differences, and 0 is a gap', () => {
  // 1, then a gap, then 3: differences 1, -1, 3, zigzag 2, 1, 6.
  const values = unpackCurve(new Uint8Array([2, 1, 6]), [0, 3, 10, 0.5]);
  assert.equal(values[0], 10);
  assert.ok(Number.isNaN(values[1]));
  assert.equal(values[2], 11);
});

test('a run of zeros repeats the value', () => {
  const values = unpackCurve(new Uint8Array([99, 4, 0, 3, 2]), [1, 6, 0, 1]);
  assert.deepEqual([...values], [1, 1, 1, 1, 1, 2]);
});

test('times go on with the last difference', () => {
  // 0 is a run of one; then 10 s in ns, and a run of two.
  const tenSeconds = [0x80, 0x90, 0xdf, 0xc0, 0x4a]; // zigzag of 1e10 is 2e10
  const times = unpackTimes(new Uint8Array([0, 0, ...tenSeconds, 0, 1]), [0, 4, 0, 1e-9]);
  assert.deepEqual([...times].map((time) => Math.round(time)), [0, 10, 20, 30]);
});

test('bytes that end too early are an error, not an endless loop', () => {
  assert.throws(() => unpackCurve(new Uint8Array([0x80]), [0, 1, 0, 1]), RangeError);
});

test('base64 is read', () => {
  assert.deepEqual([...bytesOf('//79AA==')], [255, 254, 253, 0]);
});
