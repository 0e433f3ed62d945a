import { expect, test } from 'vitest';
import type { Layer, LayerSettings } from './layers';
import { curveOf, maskChoice, maskOf, newMask, withPoint } from './masks';

const layer = (settings: LayerSettings): Layer => ({
  kind: 'rainbow',
  name: '',
  settings,
  when: { of: 'show' },
  rest: {},
});

test('one mask of a known shape can be changed, others are kept as the file has them', () => {
  expect(maskChoice(layer({}))).toBe('all');
  const circle = { shape: 'circle', center: [1, 2], radius_m: 0.5, feather_m: 0.1 };
  expect(maskChoice(layer({ masks: [circle] }))).toBe('circle');
  expect(maskOf(layer({ masks: [circle] }))).toEqual(circle);
  expect(maskChoice(layer({ masks: [{ shape: 'polygon', points: [] }] }))).toBe('other');
  expect(maskChoice(layer({ masks: [circle, circle] }))).toBe('other');
  expect(maskChoice(layer({ masks: ['circle'] }))).toBe('other');
});

test('a mask of pixels takes the chosen ones', () => {
  expect(newMask('pixels', new Set([3, 1]))).toEqual([{ shape: 'pixels', pixels: [3, 1] }]);
  expect(newMask('all', [])).toBeUndefined();
});

test('a curve is read from the document, and grows at its end', () => {
  expect(curveOf(layer({ opacity: 0.5 }))).toBeNull();
  const curve = curveOf(layer({ opacity: [[0, 0], [2, 0.8], 'x'] })) ?? [];
  expect(curve).toEqual([
    [0, 0],
    [2, 0.8],
    [0, 1],
  ]);
  expect(withPoint(curve.slice(0, 2))).toEqual([
    [0, 0],
    [2, 0.8],
    [3, 0.8],
  ]);
});
