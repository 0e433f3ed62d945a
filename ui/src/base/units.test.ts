import { expect, test } from 'vitest';
import { fromUnit, inUnit, isUnit, lengthText, sizeText, UNITS, type Unit } from './units';

test('metres on screen and back', () => {
  expect([inUnit(1.25, 'm'), inUnit(1.25, 'cm'), inUnit(1.25, 'mm')]).toEqual([1.25, 125, 1250]);
  expect(inUnit(0.3048, 'ft')).toBe(1);
  expect(inUnit(-0.000001, 'm')).toBe(0);
  for (const unit of Object.keys(UNITS) as Unit[])
    expect(fromUnit(inUnit(0.7313, unit), unit)).toBeCloseTo(0.7313, 3);
});

test('lengths for people', () => {
  expect(lengthText(0.0764, 'm')).toBe('0.076 m');
  expect(lengthText(0.0764, 'mm')).toBe('76 mm');
  expect(lengthText(0.0764, 'cm')).toBe('7.6 cm');
  expect(sizeText(3, 'm')).toBe('3 m');
  expect(sizeText(2.5, 'cm')).toBe('250 cm');
});

test('what is stored may be anything', () => {
  expect([isUnit('cm'), isUnit('furlong'), isUnit(null)]).toEqual([true, false, false]);
});
