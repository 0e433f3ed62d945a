import { expect, test } from 'vitest';
import { newShow } from '../model/show';
import { robotsToFit } from './fitness';
import { robotRow } from './robots.testing';

test('a show is offered to be fitted to the robots that can drive', () => {
  const rows = [robotRow(), robotRow(), robotRow({ presence: 'gone' })];
  expect(robotsToFit(newShow('x', 3), null, rows)).toBe(2);
  expect(robotsToFit(newShow('x', 2), null, rows)).toBeNull();
  expect(robotsToFit(newShow('x', 3), 'it holds more', rows)).toBeNull();
  expect(robotsToFit(newShow('x', 3), null, [])).toBeNull();
  expect(robotsToFit(null, null, rows)).toBeNull();
});
