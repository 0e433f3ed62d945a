import { expect, test } from 'vitest';
import { frameColours } from './frameColours';
import type { Pixel } from './show';

const pixel = (id: number, x: number, color: number): Pixel => ({
  id,
  x,
  y: 0,
  color,
  robot: null,
  part: null,
  group: null,
});

test('colours from left to right', () => {
  expect(frameColours([])).toEqual([]);
  expect(frameColours([pixel(0, 1, 0x0000ff), pixel(1, -1, 0xff0000)])).toEqual([
    0xff0000, 0x0000ff,
  ]);
  const row = Array.from({ length: 50 }, (_, i) => pixel(i, i, i < 20 ? 0x00ff00 : 0x204060));
  expect(frameColours(row)).toEqual([0x00ff00, 0x00ff00, 0x204060, 0x204060, 0x204060]);
});
