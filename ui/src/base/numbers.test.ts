import { expect, test } from 'vitest';
import { countText, readNumber, stepped } from './numbers';

const SECONDS = { min: 0, max: 3600, unit: ' s' };
const ROBOTS = { min: 1, max: 2000, whole: true };

test.each([
  ['0,5', 0.5],
  ['0.5', 0.5],
  [' 12 ', 12],
  [',25', 0.25],
  ['7,', 7],
  ['-0', 0],
])('%s is a number', (text, value) => {
  expect(readNumber(text, SECONDS)).toEqual({ ok: true, value });
});

test.each([
  ['-3', SECONDS, 'At least 0 s'],
  ['\u22123', ROBOTS, 'At least 1'],
  ['99999', ROBOTS, 'At most 2000'],
  ['1.000,5', SECONDS, 'This is not a number'],
  ['1e3', SECONDS, 'This is not a number'],
  ['five', SECONDS, 'This is not a number'],
  ['', SECONDS, 'Type a number'],
  ['1,5', ROBOTS, 'Type a whole number'],
  ['1,000', ROBOTS, 'Type a whole number'],
])('%s is refused with the reason', (text, rule, problem) => {
  expect(readNumber(text, rule)).toEqual({ ok: false, problem });
});

test('steps go to the next multiple and stop at the limits', () => {
  expect(stepped(0.3, 0.5, true, SECONDS)).toBe(0.5);
  expect(stepped(0.3, 0.1, true, SECONDS)).toBe(0.4);
  expect(stepped(0.3, 0.5, false, SECONDS)).toBe(0);
  expect(stepped(2000, 1, true, ROBOTS)).toBe(2000);
});

test('a count says one or many', () => {
  expect([countText(1, 'frame'), countText(0, 'robot')]).toEqual(['1 frame', '0 robots']);
});
