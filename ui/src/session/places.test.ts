import { expect, test } from 'vitest';
import { comparePlaces, placesVerdict, type Placed } from './places';

const robot = (name: string, x: number, y: number): Placed => ({ name, at: { x, y } });
const starts = [
  { x: 0, y: 0 },
  { x: 0.1, y: 0 },
  { x: 0.2, y: 0 },
];

test('robots stand in the nearest place, and the others are away from what is left', () => {
  const robots = [robot('a', 0.03, 0), robot('b', 0.01, 0), robot('c', 0.5, 0.4)];
  const found = comparePlaces(starts, robots, ['d']);
  expect(found.inPlace.map(({ name }) => name)).toEqual(['b']);
  expect(found.away.map(({ name, goal }) => [name, goal?.x])).toEqual([
    ['c', 0.2],
    ['a', 0.1],
  ]);
  expect(found.away[0]?.off_m).toBeCloseTo(0.5);
  expect(found.free).toEqual([]);
  expect(placesVerdict(found)).toBe(
    '1 of 3 robots in their starting places, 2 elsewhere, 1 robot without a known place.',
  );
});

test('too few and too many robots are counted', () => {
  const few = comparePlaces(starts, [robot('a', 0, 0)], []);
  expect(placesVerdict(few)).toBe(
    '1 of 1 robot in their starting places, 2 places without a robot.',
  );
  const many = comparePlaces([], [robot('a', 0, 0)], []);
  expect(many.away).toEqual([{ ...robot('a', 0, 0), goal: null, off_m: null }]);
  expect(placesVerdict(comparePlaces(starts, [], []))).toBe('No robot reports its place.');
});

test('ten thousand robots are compared with as many places', () => {
  const places = Array.from({ length: 10_000 }, (_, i) => ({
    x: (i % 100) * 0.1,
    y: Math.floor(i / 100) * 0.1,
  }));
  const robots = places.map(({ x, y }, i) => robot(String(i), x + 0.02, y));
  expect(comparePlaces(places, robots, []).inPlace.length).toBe(10_000);
  const far = robots.map(({ name, at }) => robot(name, at.x + 30, at.y));
  expect(comparePlaces(places, far, []).away.length).toBe(10_000);
});
