import type { Dot } from '../base/geometry';
import { expect, test } from 'vitest';
import { createRasteriser } from './rasteriser';
import { addLines } from './lines';

const camera = { scale: 10, originX_px: 20, originY_px: 20 };
const draw = (dots: Dot[], side = 40) => {
  const pixels = { data: new Uint8ClampedArray(side * side * 4), width: side, height: side };
  createRasteriser().addLights(pixels, dots, 4, camera, 1);
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

const rings = (dots: Dot[], floor: number, radius_px = 8) => {
  const side = 40;
  const data = new Uint8ClampedArray(side * side * 4).fill(floor);
  createRasteriser().layRings({ data, width: side, height: side }, dots, radius_px, camera, 1);
  return (x: number, y: number) => [...data.subarray((y * side + x) * 4, (y * side + x) * 4 + 3)];
};

test('a ring covers what is under its line and nothing inside or outside', () => {
  const at = rings([dot(0, 0, 0x00ff00)], 100);
  const [line, inside, outside] = [at(28, 20), at(20, 20), at(34, 20)];
  expect(line[1]).toBeGreaterThan(150);
  expect(line[0]).toBeLessThan(70);
  expect([inside, outside]).toEqual([
    [100, 100, 100],
    [100, 100, 100],
  ]);
});

test('a ring of a light that is off can be seen; a faint one hardly', () => {
  expect(rings([dot(0, 0, 0)], 0)(28, 20)[2]).toBeGreaterThan(60);
  const faint = rings([dot(0, 0, 0xffffff, 0.1)], 0)(28, 20)[0] ?? 0;
  expect(faint).toBeGreaterThan(5);
  expect(faint).toBeLessThan(30);
});

test('a line is dashed from one end to the other, and what leaves the picture is cut off', () => {
  const [side, data] = [40, new Uint8ClampedArray(40 * 40 * 4)];
  const pixels = { data, width: side, height: side };
  addLines(
    pixels,
    [
      [
        { x: -1, y: 0 },
        { x: 1, y: 0 },
      ],
    ],
    camera,
    1,
  );
  addLines(
    pixels,
    [
      [
        { x: 0, y: -1 },
        { x: 9e9, y: -1 },
      ],
    ],
    camera,
    1,
  );
  const row = (y: number) =>
    Array.from({ length: side }, (_, x) => (data[(y * side + x) * 4] ? 1 : 0));
  expect(row(20).join('')).toBe('0000000000111000111000111000111000000000');
  expect(row(30).join('')).toBe('0000000000000000000011100011100011100011');
  expect(row(19).includes(1)).toBe(false);
});

test('a robot whose light is off is a dark disc with a rim, over what is below', () => {
  const side = 40;
  const data = new Uint8ClampedArray(side * side * 4).fill(255);
  createRasteriser().layBodies({ data, width: side, height: side }, [dot(0, 0, 0)], 8, camera, 1);
  const at = (x: number) => data[(20 * side + x) * 4] ?? 0;
  const [middle, rim, outside] = [at(20), at(27), at(31)];
  expect(middle).toBe(0x1b);
  expect(rim).toBeGreaterThan(middle + 40);
  expect(rim).toBeLessThan(150);
  expect(outside).toBe(255);
});
