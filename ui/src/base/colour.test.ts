import { expect, test } from 'vitest';
import { colourName, fromHex, fromText, mix, rgb, toHex } from './colour';

test('hex in its usual spellings', () => {
  expect(fromHex('#ffa500')).toBe(0xffa500);
  expect(fromHex('FA0')).toBe(0xffaa00);
  expect(fromHex(' #12345 ')).toBeUndefined();
  expect(toHex(0x00ff01)).toBe('#00ff01');
});

test('components are rounded and kept in range', () => {
  expect(rgb(300, -4, 127.6)).toBe(0xff0080);
  expect(mix(0x000000, 0xff8000, 0.5)).toBe(0x804000);
});

test('names', () => {
  expect(colourName(0xffa500)).toBe('orange');
  expect(colourName(0)).toBe('off');
});

test('colours can be typed as hex or RGB', () => {
  expect(fromText('#ff8000')).toBe(0xff8000);
  expect(fromText(' 255, 128, 0 ')).toBe(0xff8000);
  expect(fromText('rgb(255 128 0)')).toBe(0xff8000);
  expect(fromText('256, 0, 0')).toBeUndefined();
  expect(fromText('rgb(1,2)')).toBeUndefined();
});
