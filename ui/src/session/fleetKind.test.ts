import { expect, test } from 'vitest';
import { driveQuestion, fleetKind, kindHint } from './fleetKind';

const rows = (simulated: number, real: number) => [
  ...Array.from({ length: simulated }, () => ({ simulated: true })),
  ...Array.from({ length: real }, () => ({ simulated: false })),
];

test('a fleet with one real robot is a real fleet', () => {
  expect(fleetKind(rows(0, 0))).toBeNull();
  expect(fleetKind(rows(12, 0))).toBe('simulated');
  expect(fleetKind(rows(11, 1))).toBe('real');
  expect(fleetKind(rows(0, 12))).toBe('real');
  expect(kindHint(rows(11, 1))).toBe('1 of 12 robots is real, the others are simulated.');
});

test('what is asked says how many robots leave, and how many of them are real', () => {
  expect(driveQuestion(rows(0, 12), 1)).toBe('Drive 12 real robots to frame 2?');
  expect(driveQuestion(rows(0, 2), 'home')).toBe('Drive 2 real robots to their starting places?');
  expect(driveQuestion(rows(9, 3), 0)).toBe('Drive 12 robots to frame 1, 3 of them real?');
});
