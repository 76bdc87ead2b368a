import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileName, numberText, timeText } from './format';

test('numbers have as many digits as are asked for', () => {
  assert.equal(numberText(1234.567), '1235');
  assert.equal(numberText(12.34567), '12.35');
  assert.equal(numberText(-0.012345), '\u22120.012');
  assert.equal(numberText(0), '0.000');
  assert.equal(numberText(1.5e-9), '1.500e\u22129');
  assert.equal(numberText(-2e7, 2), '\u22122.0e+7');
  assert.equal(numberText(NaN), '–');
});

test('times have minutes when there are some', () => {
  assert.equal(timeText(7.254), '7.25 s');
  assert.equal(timeText(59.999), '1:00.00');
  assert.equal(timeText(603.4), '10:03.40');
});

test('a file is called by the last part of its path', () => {
  assert.equal(fileName('out/demo.bag'), 'demo.bag');
  assert.equal(fileName('demo.bag'), 'demo.bag');
});
