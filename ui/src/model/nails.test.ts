import { expect, test } from 'vitest';
import { setFrames } from './commands';
import { beginOf, fitNails } from './nails';
import { newFrame, newShow } from './show';
import { segmentsOf } from './timeline';

/** Duration of every drive, seconds. */
const DRIVE_S = 2;

function show(airTimes: readonly number[], nails: Readonly<Record<number, number>>) {
  const frames = airTimes.map((airTime_s, i) => ({
    ...newFrame(`F${i}`, []),
    airTime_s,
    at_s: nails[i] ?? null,
  }));
  return { ...newShow('Nails', 2), frames };
}

const timeline = (of: ReturnType<typeof show>) => segmentsOf(of, () => DRIVE_S);
const fitted = (of: ReturnType<typeof show>) => {
  const fit = fitNails(of, timeline(of));
  return {
    airTimes: fit.frames.map((frame) => frame.airTime_s),
    begins: fit.frames.map((_, i) =>
      beginOf(
        segmentsOf(fit, () => DRIVE_S),
        i,
      ),
    ),
  };
};

test('a picture that would be early lets the one before stand longer', () => {
  expect(fitted(show([3, 3, 3], { 2: 12 }))).toEqual({ airTimes: [3, 5, 3], begins: [0, 5, 12] });
});

test('a picture that would be late takes time from those before it', () => {
  expect(fitted(show([3, 3, 3], { 2: 6.5 }))).toEqual({
    airTimes: [2, 0.5, 3],
    begins: [0, 4, 6.5],
  });
});

test('time is not taken from before another nailed picture, and what is missing stays', () => {
  const { airTimes, begins } = fitted(show([3, 3, 3, 3], { 1: 5, 3: 8 }));
  expect(airTimes).toEqual([3, 0.5, 0.5, 3]);
  expect(begins[1]).toBe(5);
  expect(begins[3]).toBe(10);
});

test('a show without nails stays the same show, and a nail is taken off', () => {
  const plain = show([3, 3], {});
  expect(fitNails(plain, timeline(plain))).toBe(plain);
  const nailed = setFrames(plain, [1], { at_s: 4 });
  expect(setFrames(nailed, [1], { at_s: null }).frames[1]?.at_s).toBeNull();
});
