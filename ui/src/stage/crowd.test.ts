import { expect, test } from 'vitest';
import { createCrowd } from './crowd';
import type { Dot } from './scene';

const camera = { scale: 10, originX_px: 20, originY_px: 20 };
const draw = (dots: Dot[], side = 40) => {
  const pixels = { data: new Uint8ClampedArray(side * side * 4), width: side, height: side };
  createCrowd().add(pixels, dots, 4, camera, 1);
  return (x: number, y: number) => [
    ...pixels.data.subarray((y * side + x) * 4, (y * side + x) * 4 + 3),
  ];
};
const dot = (x: number, y: number, color: number, alpha = 1): Dot => ({ x, y, color, alpha });

test('a light is brightest in its middle, in its colour, and dark beyond its glow', () => {
  const at = draw([dot(0, 0, 0xff0000)]);
  const [middle, rim, beyond] = [at(20, 20), at(24, 20), at(38, 20)];
  expect(middle[0]).toBe(255);
  expect(middle[1]).toBeGreaterThan(rim[1] ?? 0);
  expect(rim[0]).toBeGreaterThan(40);
  expect(rim[0]).toBeLessThan(200);
  expect(rim[1]).toBe(0);
  expect(beyond).toEqual([0, 0, 0]);
});

test('y is up, lights add up, silent ones are faint', () => {
  expect(draw([dot(0, 1, 0x00ff00)])(20, 10)[1]).toBe(255);
  const one = draw([dot(0, 0, 0x0000ff)])(26, 20)[2] ?? 0;
  const two = draw([dot(0, 0, 0x0000ff), dot(1.2, 0, 0x0000ff)])(26, 20)[2] ?? 0;
  expect(two).toBeGreaterThan(one * 1.5);
  expect(draw([dot(0, 0, 0x0000ff, 0.2)])(20, 20)[2]).toBeLessThan(80);
});

test('what moves a quarter of a pixel is drawn elsewhere; what leaves the picture is cut off', () => {
  expect(draw([dot(0, 0, 0xffffff)])(24, 20)).not.toEqual(draw([dot(0.025, 0, 0xffffff)])(24, 20));
  const at = draw([dot(-2, 2, 0xffffff), dot(9, 9, 0xffffff), dot(-9, -9, 0xffffff)]);
  expect(at(0, 0)[0]).toBe(255);
  expect(at(39, 1)).toEqual([0, 0, 0]);
});
