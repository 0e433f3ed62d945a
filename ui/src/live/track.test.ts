import { expect, test } from 'vitest';
import type { Robots } from '../api/types.gen';
import { createTrack, sampleBetween } from './track';

const robots = (over: Partial<Robots>): Robots => ({
  x: [0],
  y: [0],
  heading: [null],
  colour: [0xff0000],
  status: [0],
  planned_x: [null],
  planned_y: [null],
  goal_x: [null],
  goal_y: [null],
  ...over,
});
const solid = () => 1;

test('robots are drawn between the last two snapshots', () => {
  const track = createTrack();
  track.push(robots({ x: [0] }), 1000);
  track.push(robots({ x: [0.01] }), 1050);
  expect(track.sample(1025, solid).filled[0]?.x).toBe(0);
  expect(track.sample(1075, solid).filled[0]?.x).toBeCloseTo(0.005, 9);
  expect(track.sample(9999, solid).filled[0]?.x).toBe(0.01);
});

test('a jump is not a drive', () => {
  const sample = sampleBetween(robots({ x: [-1] }), robots({ x: [1] }), 0.5, solid);
  expect(sample.filled[0]?.x).toBe(1);
});

test('unknown places are not drawn, and the line leads to where the path says, or else to the goal', () => {
  const unknown = robots({ x: [null], goal_x: [0.5], goal_y: [0] });
  expect(sampleBetween(unknown, unknown, 1, solid)).toMatchObject({ filled: [], errors: [] });
  const known = robots({ goal_x: [0.5], goal_y: [0] });
  expect(sampleBetween(known, known, 1, solid).errors).toHaveLength(1);
  const late = robots({ planned_x: [0.1], planned_y: [0], goal_x: [0.5], goal_y: [0] });
  expect(sampleBetween(late, late, 1, solid).errors[0]?.[1]).toEqual({ x: 0.1, y: 0 });
  const near = robots({ goal_x: [0.01], goal_y: [0] });
  expect(sampleBetween(near, near, 1, solid)).toMatchObject({ errors: [] });
});

test('another number of robots starts afresh', () => {
  const track = createTrack();
  track.push(robots({ x: [0.1] }), 0);
  track.push(robots({ x: [0.2, 0.3], y: [0, 0] }), 50);
  expect(track.sample(50, solid).filled.map((d) => d.x)).toEqual([0.2, 0.3]);
});
