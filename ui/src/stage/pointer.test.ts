import { expect, test } from 'vitest';
import { stageFromCanvas } from './camera';
import { pinch } from './pointer';

const camera = { scale: 200, originX_px: 300, originY_px: 240 };

test('what is under two fingers stays under them', () => {
  const [before, other, at] = [
    { x: 100, y: 100 },
    { x: 200, y: 100 },
    { x: 50, y: 100 },
  ];
  const after = pinch(camera, before, at, other);
  expect(after.scale).toBe(300);
  for (const [was, is] of [
    [before, at],
    [other, other],
  ] as const) {
    const [a, b] = [stageFromCanvas(camera, was), stageFromCanvas(after, is)];
    expect(b.x).toBeCloseTo(a.x, 12);
    expect(b.y).toBeCloseTo(a.y, 12);
  }
});

test('fingers on one spot do not throw the floor away', () => {
  const spot = { x: 100, y: 100 };
  expect(pinch(camera, spot, spot, spot)).toEqual(camera);
});
