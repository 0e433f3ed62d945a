import { expect, test } from 'vitest';
import type { PreflightState } from '../api/types.gen';
import { preflightDoing, preflightVerdict } from './preflight';

const state = (over: Partial<PreflightState>): PreflightState => ({
  doing: null,
  round: 1,
  rounds: 1,
  finished: true,
  passed: 0,
  named: 0,
  ...over,
});

test('rounds are counted only where robots take turns', () => {
  expect(preflightDoing(state({ doing: 'driving out' }))).toBe('Driving out');
  expect(preflightDoing(state({ doing: 'measuring', round: 2, rounds: 3 }))).toBe(
    'Measuring (round 2 of 3)',
  );
});

test('the verdict says how many passed, and whether all were tested', () => {
  expect(preflightVerdict(state({ passed: 4 }))).toBe('All 4 robots passed.');
  expect(preflightVerdict(state({ passed: 3, named: 1 }))).toBe('3 of 4 robots passed.');
  expect(preflightVerdict(state({ named: 1, finished: false }))).toBe(
    'The preflight ended early: 0 of 1 robot passed.',
  );
});
