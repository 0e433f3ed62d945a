import { expect, test } from 'vitest';
import type { Path } from '../api/types.gen';
import { pathAt, polyline } from './path';

const path: Path = {
  start: [0, 0],
  pieces: [
    [1, 0, 0, 0, 0, 0, 0],
    [3, 1, 0, 2, 0, 3, 0],
    [1, 3, 1, 4, 1, 4, 0],
  ],
};

test.each([
  [-1, 0, 0],
  [0.5, 0, 0],
  [2, 1, 0],
  [4, 3, 0],
  [4.5, 3.5, 0.75],
  [99, 4, 0],
])('at %d s it is at %d, %d', (t, x, y) => {
  const at = pathAt(path, t);
  expect(at.x).toBeCloseTo(x, 9);
  expect(at.y).toBeCloseTo(y, 9);
});

test('straight pieces need one point, curves ten', () => {
  expect(polyline(path)).toHaveLength(1 + 1 + 1 + 10);
});
