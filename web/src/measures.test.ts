import assert from 'node:assert/strict';
import { test } from 'node:test';
import { measuresOf } from './measures';

void test('each line but the first is a name and a value', () => {
  const text = 'zz (zig_zag), first execute at 10 s, end at 20 s\n  reach: 2.5 s\n  step 1: rise time: 0.4 s\n';
  assert.deepEqual(measuresOf(text), [['reach', '2.5 s'], ['step 1: rise time', '0.4 s']]);
});

void test('a text of another kind has no measures', () => {
  assert.deepEqual(measuresOf(''), []);
  assert.deepEqual(measuresOf('a\nb'), []);
});
