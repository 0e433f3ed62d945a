import { expect, test } from 'vitest';
import { createCloseWatch } from './closeWatch';

const at = (...xs: number[]) => xs.map((x) => ({ x, y: 0 }));

test('robots that touch are found, a few times a second', () => {
  const watch = createCloseWatch();
  expect(watch.find(at(0, 0.05, 1), 0.054, 0)).toEqual([0, 1]);
  expect(watch.find(at(0, 0.5, 1), 0.054, 100)).toEqual([0, 1]);
  expect(watch.find(at(0, 0.5, 1), 0.054, 250)).toEqual([]);
  expect(watch.find(at(0, 0.01), 0.054, 260)).toEqual([0, 1]);
});
