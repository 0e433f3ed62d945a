import { type Point, inPolygon, rotate } from '../base/geometry';
import { expect, test } from 'vitest';
import { align, distribute, mirror, spread } from './arrange';

const at = (...pairs: [number, number][]): Point[] => pairs.map(([x, y]) => ({ x, y }));
const least = (points: Point[]) =>
  Math.min(
    ...points.flatMap((a, i) => points.slice(i + 1).map((b) => Math.hypot(a.x - b.x, a.y - b.y))),
  );

test('align', () => {
  expect(align(at([0, 0], [2, 1]), 'right')).toEqual(at([2, 0], [2, 1]));
  expect(align(at([0, 0], [2, 1]), 'top')).toEqual(at([0, 1], [2, 1]));
});

test('distribute keeps the outermost two and the order', () => {
  expect(distribute(at([3, 9], [0, 7], [1, 5]), 'x')).toEqual(at([3, 9], [0, 7], [1.5, 5]));
});

test('spread parts even those on one place, and leaves the rest', () => {
  const points = spread(at([0, 0], [0, 0], [0.05, 0], [1, 1]), 0.08);
  expect(least(points)).toBeGreaterThan(0.0799);
  expect(points[3]).toEqual({ x: 1, y: 1 });
});

test('mirror twice is nothing', () => {
  const places = at([0, 0], [2, 1], [0.5, 3]);
  expect(mirror(mirror(places, 'x'), 'x')).toEqual(places);
});

test('geometry', () => {
  expect(inPolygon({ x: 0.5, y: 0.5 }, at([0, 0], [1, 0], [1, 1], [0, 1]))).toBe(true);
  expect(inPolygon({ x: 1.5, y: 0.5 }, at([0, 0], [1, 0], [1, 1], [0, 1]))).toBe(false);
  expect(rotate({ x: 1, y: 0 }, { x: 0, y: 0 }, Math.PI / 2).y).toBeCloseTo(1, 12);
});
