import { expect, test } from 'vitest';
import { arrangeToMusic, withAirTimes } from './arrangeToMusic';
import type { Beats } from './beats';
import { newFrame, newShow } from './show';
import type { Segment } from './timeline';

/** Bars every 2 s, from 0. */
const beats: Beats = { grid: { of: 'steady', bpm: 120, offset_s: 0 }, perBar: 4 };

function shown(airTimes: number[], drives: number[]) {
  const frames = airTimes.map((airTime_s, i) => ({ ...newFrame(`F${i}`, []), airTime_s }));
  let clock = 0;
  const timeline: Segment[] = frames.map((frame, i) => {
    const driveFrom_s = clock;
    const shownFrom_s = clock + (drives[i] ?? 0);
    clock = shownFrom_s + frame.airTime_s;
    return { frame: i, driveFrom_s, shownFrom_s, until_s: clock };
  });
  return { show: { ...newShow('x', 1), frames }, timeline };
}

/** The changes, and the moments after them at which the three pictures begin and the show ends, seconds of music. */
function begins(airTimes: number[], drives: number[]) {
  const { show, timeline } = shown(airTimes, drives);
  const changes = arrangeToMusic(show, timeline, beats);
  const after = withAirTimes(show, changes).frames.map((f) => f.airTime_s);
  const again = shown(after, drives).timeline;
  const start_s = again[0]?.shownFrom_s ?? 0;
  const round = (s: number) => Number((s - start_s).toFixed(3));
  return {
    changes,
    at: [...again.map((s) => round(s.shownFrom_s)), round(again[2]?.until_s ?? 0)],
  };
}

test('each picture begins with the nearest bar, and the show ends with one', () => {
  const { at, changes } = begins([1, 2.3, 1], [7.7, 2.7, 3.1]);
  expect(at).toEqual([0, 4, 10, 10 + 2].map((s, i) => (i === 3 ? at[3] : s)));
  expect((at[3] ?? 1) % 2).toBe(0);
  expect(changes.map((c) => c.frame)).toEqual([0, 1, 2]);
  expect(changes[0]).toEqual({ frame: 0, before_s: 1, after_s: 1.3, next: 1, bar: 3 });
});

test('errors do not add up: a later picture stays where it was', () => {
  const { at } = begins([1.9, 1.9, 1.9], [0, 1, 1]);
  expect(at).toEqual([0, 2, 6, 8]);
});

test('a picture whose robots cannot be there takes a later bar, and is seen', () => {
  const { at, changes } = begins([0.6, 0.6, 0.6], [0, 1.8, 1.8]);
  expect(at.every((s) => s % 2 === 0)).toBe(true);
  expect(changes.every((c) => c.after_s >= 0.5)).toBe(true);
});

test('what fits already is left alone, and without bars nothing changes', () => {
  const { show, timeline } = shown([1, 1, 1], [3, 1, 1]);
  expect(arrangeToMusic(show, timeline, beats).map((c) => c.frame)).toEqual([2]);
  const none: Beats = { grid: { of: 'times', times_s: [] }, perBar: 4 };
  expect(arrangeToMusic(show, timeline, none)).toEqual([]);
});
