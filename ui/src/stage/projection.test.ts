import { expect, test } from 'vitest';
import { newSeen, projectionOf, type Viewpoint } from './projection';

const FLOOR = { width_m: 4, depth_m: 3 };

function seen(
  viewpoint: Viewpoint,
  x: number,
  y: number,
  size = { width_px: 800, height_px: 600 },
) {
  const place = newSeen();
  projectionOf(viewpoint, FLOOR, size)({ x, y }, place);
  return place;
}

test('from above the floor keeps its shape, with its far edge on top', () => {
  const [middle, corner] = [seen('above', 0, 0), seen('above', 2, 1.5)];
  expect(middle).toMatchObject({ x_px: 400, y_px: 300, flatness: 1 });
  expect(corner.x_px - 400).toBeCloseTo(2 * corner.scale, 9);
  expect(300 - corner.y_px).toBeCloseTo(1.5 * corner.scale, 9);
});

for (const [width_px, height_px] of [
  [1440, 900],
  [1024, 768],
  [390, 844],
] as const)
  test(`both viewpoints show the whole floor, ${width_px} wide`, () => {
    for (const viewpoint of ['above', 'front'] as const) {
      const corners = [-2, 2].flatMap((x) =>
        [-1.5, 1.5].map((y) => seen(viewpoint, x, y, { width_px, height_px })),
      );
      for (const { x_px, y_px } of corners) {
        expect(x_px).toBeGreaterThan(0);
        expect(x_px).toBeLessThan(width_px);
        expect(y_px).toBeGreaterThan(0);
        expect(y_px).toBeLessThan(height_px);
      }
      const wide =
        Math.max(...corners.map((c) => c.x_px)) - Math.min(...corners.map((c) => c.x_px));
      const high =
        Math.max(...corners.map((c) => c.y_px)) - Math.min(...corners.map((c) => c.y_px));
      expect(Math.max(wide / width_px, high / height_px)).toBeGreaterThan(0.9);
    }
  });

test('from the front what is near is larger, lower and wider apart, and straight lines stay straight', () => {
  const [near, middle, far] = [-1.5, 0, 1.5].map((y) => seen('front', 1, y)) as [
    ReturnType<typeof seen>,
    ReturnType<typeof seen>,
    ReturnType<typeof seen>,
  ];
  expect(near.scale).toBeGreaterThan(1.5 * far.scale);
  expect(near.y_px).toBeGreaterThan(middle.y_px);
  expect(middle.y_px).toBeGreaterThan(far.y_px);
  const slope = (a: typeof near, b: typeof near) => (a.x_px - b.x_px) / (a.y_px - b.y_px);
  expect(slope(near, middle)).toBeCloseTo(slope(middle, far), 9);
  expect(near.flatness).toBeGreaterThan(far.flatness);
  expect(near.flatness).toBeLessThan(1);
});

test('a small step is as long as the scale and the flatness say', () => {
  const [at, beside, behind] = [
    seen('front', 0, 0),
    seen('front', 0.001, 0),
    seen('front', 0, 0.001),
  ];
  expect(beside.x_px - at.x_px).toBeCloseTo(0.001 * at.scale, 3);
  expect((at.y_px - behind.y_px) / 0.001 / at.scale).toBeCloseTo(at.flatness, 2);
});

test('a robot behind the viewer is not drawn', () => {
  expect(seen('front', 0, -9).scale).toBe(0);
});
