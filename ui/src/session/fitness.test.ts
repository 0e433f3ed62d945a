import { expect, test } from 'vitest';
import { setSpares } from '../model/commands';
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

test('spare robots are no reason to fit a show', () => {
  const rows = [robotRow(), robotRow(), robotRow()];
  const withSpares = (pixels: number, spares: number) =>
    robotsToFit(setSpares(newShow('x', pixels), spares), null, rows);
  expect([withSpares(2, 1), withSpares(2, 2), withSpares(3, 2)]).toEqual([null, null, null]);
  expect([withSpares(1, 1), withSpares(4, 1)]).toEqual([3, 3]);
});
