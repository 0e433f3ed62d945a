import { expect, test } from 'vitest';
import { stageFromCanvas } from './camera';
import { pinch, turned } from './viewPointer';

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

test('a wheel zooms, two fingers on a touchpad pan and pinch, Shift and a tilted wheel go sideways', () => {
  const at = { x: 120, y: 80 };
  const turn = { deltaX: 0, deltaY: 0, deltaMode: 0, ctrlKey: false, shiftKey: false };
  const notch = { ...turn, deltaY: 100, wheelDeltaY: -120 };
  expect(turned(camera, at, notch).scale).toBeLessThan(camera.scale);
  const fingers = { ...turn, deltaX: 4, deltaY: -7, wheelDeltaY: 21 };
  expect(turned(camera, at, fingers)).toEqual({ scale: 200, originX_px: 296, originY_px: 247 });
  const pinched = { ...turn, deltaY: -7, wheelDeltaY: 21, ctrlKey: true };
  expect(turned(camera, at, pinched).scale).toBeCloseTo(camera.scale * Math.exp(0.07), 9);
  const sideways = { ...notch, shiftKey: true };
  expect(turned(camera, at, sideways)).toEqual({ ...camera, originX_px: 200 });
  const tilted = { ...turn, deltaX: 100, wheelDeltaY: 0 };
  expect(turned(camera, at, tilted)).toEqual({ ...camera, originX_px: 200 });
});
