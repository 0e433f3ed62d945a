import { expect, test } from 'vitest';
import { addFrame } from './commands';
import { newShow } from './show';
import {
  dragStep_s,
  fittingScale,
  momentAt,
  snapMoment,
  ticksBetween,
  tickStep_s,
  xOf,
} from './timelineAxis';
import { blocksOf } from './timelineBlocks';
import { addMarker, addSection } from './timelineMarks';
import { snapMoments } from './timelineSnap';

const axis = { from_s: -4, to_s: 60, scale: 20 };

test('moments and places', () => {
  expect(xOf(axis, 0)).toBe(80);
  expect(momentAt(axis, 80)).toBe(0);
  expect(fittingScale(64, 640)).toBe(10);
});

test('ticks are far enough apart to be read, and on the timeline', () => {
  expect(tickStep_s(20)).toBe(5);
  expect(ticksBetween(axis, 0, 400)).toEqual([0, 5, 10, 15]);
  expect(ticksBetween(axis, -999, 60)).toEqual([]);
  expect(ticksBetween(axis, 1200, 9999)).toEqual([60]);
  for (const scale of [0.2, 1, 7, 33, 400]) expect(tickStep_s(scale) * scale).toBeGreaterThan(63);
});

test('snaps to the nearest moment in reach, else to a step', () => {
  expect(snapMoment(4.9, [5, 4.7], 0.3, 0.1)).toBe(5);
  expect(snapMoment(4.44, [5], 0.3, 0.1)).toBeCloseTo(4.4, 9);
  expect(dragStep_s(20)).toBe(0.1);
  expect(dragStep_s(400)).toBe(0.01);
});

test('nothing snaps to itself, nor to what moves with it', () => {
  const show = addSection(addMarker(addFrame(newShow('x', 2), 0), 7.5), 3, 4);
  const blocks = blocksOf(show, new Map());
  const moments = (what: 'block' | 'marker' | 'section', index = 0) =>
    snapMoments(show, blocks, { what, index }, [9.25]);
  expect(moments('marker')).toEqual([0, 1, 1, 2, 3, 4, 9.25]);
  expect(moments('section')).toEqual([0, 1, 1, 2, 7.5, 9.25]);
  expect(moments('block')).toEqual([7.5, 3, 4, 9.25]);
  expect(moments('block', 1)).toEqual([0, 1, 7.5, 3, 4, 9.25]);
});
