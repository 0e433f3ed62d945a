import { expect, test } from 'vitest';
import type { Plan, Transition } from '../api/types.gen';
import { addFrame, recolour, setFrames } from './commands';
import { newShow } from './show';
import { dotsAt, segmentAt, timelineOf, totalOf, previewFrom } from './timeline';

const transition = (to: number, x: number): Transition => ({
  from: to === 0 ? null : to - 1,
  to,
  duration_s: 2,
  least_s: 2,
  lower_bound_s: 1,
  closest_m: null,
  stop_safe: 1,
  pixels: [0],
  paths: [{ start: [0, 0], pieces: [[2, x / 3, 0, (2 * x) / 3, 0, x, 0]] }],
});
const plan: Plan = {
  revision: 1,
  planning: false,
  ok: true,
  duration_s: 7,
  lower_bound_s: 0,
  closest_m: null,
  stop_safe: 1,
  plan_ms: 0,
  issues: [],
  transitions: [transition(0, 0), transition(1, 1)],
};
const show = setFrames(
  recolour(addFrame(newShow('x', 1), 0), 1, new Map([[0, 0x00c878]])),
  [0, 1],
  { airTime_s: 1.5 },
);

test('drives and air times add up', () => {
  const timeline = timelineOf(show, plan);
  expect(totalOf(timeline)).toBe(7);
  expect(segmentAt(timeline, 3.6)?.frame).toBe(1);
  expect(segmentAt(timeline, 99)?.frame).toBe(1);
  expect(totalOf(timelineOf(show, null))).toBe(3);
});

test('in the middle of a drive, place and colour are in the middle', () => {
  const timeline = timelineOf(show, plan);
  const [dot] = dotsAt(show, plan, timeline, 4.5);
  expect(dot?.x).toBeCloseTo(0.5, 9);
  expect(dot?.color).toBe(0x80c878);
  expect(dotsAt(show, plan, timeline, 6.9)[0]?.x).toBe(1);
});

test('watching begins where one looks, or with the frame on the stage', () => {
  const segment = (frame: number) => ({
    frame,
    driveFrom_s: frame * 3,
    shownFrom_s: frame * 3 + 2,
    until_s: frame * 3 + 3,
  });
  const timeline = [0, 1, 2].map(segment);
  expect(previewFrom(timeline, 1, 4.5)).toBe(4.5);
  expect(previewFrom(timeline, 1, null)).toBe(5);
  expect(previewFrom(timeline, 0, null)).toBe(0);
  expect(previewFrom(timeline, 2, null)).toBe(0);
  expect(previewFrom(timeline, 1, 9)).toBe(5);
  expect(previewFrom([], 0, null)).toBe(0);
});
