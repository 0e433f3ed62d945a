import { expect, test } from 'vitest';
import { ROBOT_STATUSES } from '../api/types.gen';
import { robotsOf } from '../session/robots.testing';
import { createEvenMotion, type EvenMotion } from './evenMotion';

const all = () => true;
const xAt = (motion: EvenMotion, now_ms: number) => motion.sample(now_ms, all)[0]?.x ?? NaN;

/**
 * Where a robot with these reports is drawn along x, metres, sixty times a second until `until_ms`. It is
 * `driving` until its last report.
 */
function drawn(reports: readonly (readonly [at_ms: number, x: number])[], until_ms: number) {
  const motion = createEvenMotion();
  const left = [...reports];
  const places: number[] = [];
  let x = 0;
  for (let now_ms = 0; now_ms < until_ms; now_ms += 1000 / 60) {
    while (left[0] && left[0][0] <= now_ms) x = left.shift()?.[1] ?? x;
    const status = ROBOT_STATUSES.indexOf(left.length > 0 ? 'driving' : 'ready');
    motion.push(robotsOf({ x: [x], status: [status] }), now_ms);
    places.push(xAt(motion, now_ms));
  }
  return places;
}

const steps = (places: readonly number[]) =>
  places.slice(1).map((place, i) => place - (places[i] ?? place));

test('a robot at constant speed moves evenly, although its reports jitter', () => {
  const jitter_ms = [0, 20, -20, 25, -15, 10, 25, -25, 5, -15, 25, 0];
  const reports = jitter_ms.map((off_ms, i) => [500 * i + 50 + off_ms, 0.1 * i] as const);
  const moved = steps(drawn(reports, 5500)).slice(120);
  const even = 0.2 / 60;
  for (const step of moved) {
    expect(step).toBeGreaterThan(0.6 * even);
    expect(step).toBeLessThan(1.4 * even);
  }
});

test('speed changes without a jolt from the start to the stop, and no robot drives past its end', () => {
  // From rest with 0.2 m/s², then back to rest.
  const reports = [0, 0.025, 0.1, 0.2, 0.275, 0.3].map((x, i) => [1000 + 500 * i, x] as const);
  const places = drawn(reports, 6000);
  const speeds = steps(places);
  const changes = speeds.slice(1).map((speed, i) => Math.abs(speed - (speeds[i] ?? speed)));
  // Less than a fifth of the top speed within one picture.
  expect(Math.max(...changes)).toBeLessThan(0.2 / 60 / 5);
  expect(Math.max(...places)).toBeLessThan(0.301);
  expect(places.at(-1)).toBeCloseTo(0.3, 6);
});

test('a carried robot and an unknown one are drawn at once', () => {
  const motion = createEvenMotion();
  motion.push(robotsOf({ x: [NaN] }), 0);
  expect(motion.sample(0, all)).toEqual([]);
  motion.push(robotsOf({ x: [-1] }), 50);
  expect(xAt(motion, 50)).toBe(-1);
  motion.push(robotsOf({ x: [1] }), 100);
  expect(xAt(motion, 100)).toBe(1);
});

test('colours change within one message, and a robot that is left out is not drawn', () => {
  const motion = createEvenMotion();
  motion.push(robotsOf({ colour: [0xff0000, 0x0000ff] }), 0);
  motion.push(robotsOf({ colour: [0x000000, 0x0000ff] }), 50);
  expect(motion.sample(75, all).map(({ color }) => color)).toEqual([0x800000, 0x0000ff]);
  expect(motion.sample(100, all).map(({ color }) => color)).toEqual([0, 0x0000ff]);
  expect(motion.sample(100, (robot) => robot === 1)).toHaveLength(1);
});

test('it is still when all have arrived, and not before', () => {
  const motion = createEvenMotion();
  motion.push(robotsOf({ x: [0] }), 0);
  motion.push(robotsOf({ x: [0] }), 50);
  expect(motion.isStill(200)).toBe(true);
  motion.push(robotsOf({ x: [0.1] }), 500);
  expect(motion.isStill(700)).toBe(false);
  expect(motion.isStill(1500)).toBe(true);
});

test('another number of robots starts afresh', () => {
  const motion = createEvenMotion();
  motion.push(robotsOf({ x: [0.1] }), 0);
  motion.push(robotsOf({ x: [0.2, 0.3], y: [0, 0] }), 50);
  expect(motion.sample(50, all).map(({ x }) => x)).toEqual([0.2, 0.3].map(Math.fround));
});
