import { expect, test } from 'vitest';
import { robotsOf } from './robots.testing';
import { createTrack } from './track';

const solid = () => 1;

test('a robot is drawn on its way between its last two reports', () => {
  const track = createTrack();
  track.push(robotsOf({ x: [0] }), 0);
  for (let t = 50; t < 500; t += 50) track.push(robotsOf({ x: [0] }), t);
  track.push(robotsOf({ x: [0.1] }), 500);
  expect(track.sample(500, solid).filled[0]?.x).toBe(0);
  expect(track.sample(750, solid).filled[0]?.x).toBeCloseTo(0.05, 6);
  track.push(robotsOf({ x: [0.2] }), 1000);
  expect(track.sample(1000, solid).filled[0]?.x).toBeCloseTo(0.1, 6);
  expect(track.sample(9999, solid).filled[0]?.x).toBe(Math.fround(0.2));
});

test('who was carried is not drawn driving', () => {
  const track = createTrack();
  track.push(robotsOf({ x: [-1] }), 0);
  track.push(robotsOf({ x: [1] }), 500);
  expect(track.sample(500, solid).filled[0]?.x).toBe(1);
});

test('the error is that of the moment of the report', () => {
  const track = createTrack();
  const meant = { planned_x: [0.125], planned_y: [0], goal_x: [0.5], goal_y: [0] };
  track.push(robotsOf(meant), 0);
  track.push(robotsOf({ ...meant, planned_x: [0.2] }), 50);
  expect(track.sample(50, solid).errors[0]?.[1]).toEqual({ x: 0.125, y: 0 });
  track.push(robotsOf({ ...meant, planned_x: [0.375] }), 2000);
  expect(track.sample(2000, solid).errors[0]?.[1]).toEqual({ x: 0.375, y: 0 });
});

test('unknown places are not drawn; small errors are not worth a line', () => {
  const track = createTrack();
  track.push(robotsOf({ x: [NaN], goal_x: [0.5], goal_y: [0] }), 0);
  expect(track.sample(0, solid)).toMatchObject({ filled: [], errors: [], hollow: [{ x: 0.5 }] });
  track.push(robotsOf({ goal_x: [0.01], goal_y: [0] }), 50);
  expect(track.sample(50, solid)).toMatchObject({ errors: [], filled: [{ x: 0 }] });
});

test('another number of robots starts afresh', () => {
  const track = createTrack();
  track.push(robotsOf({ x: [0.1] }), 0);
  track.push(robotsOf({ x: [0.2, 0.3], y: [0, 0] }), 50);
  expect(track.sample(50, solid).filled.map((d) => d.x)).toEqual([0.2, 0.3].map(Math.fround));
});
