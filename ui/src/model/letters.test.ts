import { expect, test } from 'vitest';
import { letterPoints, strokesOf } from './letters';

test.each(['A', 'HI', '3210', 'LOVE'])('%s with 30 robots uses them all, apart', (word) => {
  const points = letterPoints(word, 30);
  expect(points).toHaveLength(30);
  points.forEach((a, i) =>
    points
      .slice(i + 1)
      .forEach((b) => expect(Math.hypot(a.x - b.x, a.y - b.y)).toBeGreaterThan(0.15)),
  );
});

test('every stroke stays in its box', () => {
  for (const letter of 'ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789!?+-.')
    for (const p of strokesOf(letter).flat()) {
      expect(p.x >= 0 && p.x <= 2 && p.y >= 0 && p.y <= 4).toBe(true);
    }
});

test('what cannot be written is left out', () => {
  expect(letterPoints('€', 5)).toEqual([]);
  expect(letterPoints('I', 1)).toHaveLength(1);
});
