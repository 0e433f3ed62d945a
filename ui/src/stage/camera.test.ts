import { expect, test } from 'vitest';
import { canvasFromStage, fit, gridStep, stageFromCanvas, zoomAt } from './camera';

const camera = fit(3, 3, { width_px: 660, height_px: 800 }, 30);

test('the floor fits and stands in the middle, y up', () => {
  expect(camera.scale).toBe(200);
  expect(canvasFromStage(camera, { x: -1.5, y: 1.5 })).toEqual({ x: 30, y: 100 });
});

test('there and back', () => {
  const p = stageFromCanvas(camera, canvasFromStage(camera, { x: 0.3, y: -1.2 }));
  expect(p.x).toBeCloseTo(0.3, 12);
  expect(p.y).toBeCloseTo(-1.2, 12);
});

test('zooming keeps the place under the pointer', () => {
  const at = { x: 123, y: 456 };
  const before = stageFromCanvas(camera, at);
  const after = stageFromCanvas(zoomAt(camera, at, 3.7), at);
  expect(after.x).toBeCloseTo(before.x, 9);
  expect(after.y).toBeCloseTo(before.y, 9);
});

test.each([
  [200, 0.5],
  [600, 0.1],
  [3000, 0.02],
  [20, 5],
])('grid at %d px a metre: %d m', (scale, step) => expect(gridStep(scale)).toBeCloseTo(step, 9));
