import { expect, test } from 'vitest';
import { marksOf } from './marks';
import { EMPTY_STAGE, tooClose_m, type Pixel } from './show';

test('pixels that are too close are found, wherever the squares of the search lie', () => {
  const chance = (n: number) => (Math.abs(Math.sin(n * 12.9898)) * 43758.5453) % 1;
  const pixels: Pixel[] = Array.from({ length: 300 }, (_, id) => ({
    id,
    x: chance(2 * id + 1) * 2.8 - 1.4,
    y: chance(2 * id + 2) * 2.8 - 1.4,
    color: 0,
    robot: null,
    part: null,
    group: null,
  }));
  const gap_m = tooClose_m(EMPTY_STAGE);
  const wanted = pixels.filter((p) =>
    pixels.some((q) => q !== p && Math.hypot(q.x - p.x, q.y - p.y) < gap_m),
  );
  const found = marksOf(pixels, EMPTY_STAGE).tooClose;
  expect(wanted.length).toBeGreaterThan(20);
  expect(wanted.length).toBeLessThan(300);
  expect([...found].sort((a, b) => a - b)).toEqual(wanted.map((p) => p.id));
});
