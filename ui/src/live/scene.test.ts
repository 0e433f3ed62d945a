import { expect, test } from 'vitest';
import type { FleetRow, Presence } from '../api/types.gen';
import { newShow } from '../model/show';
import { createCloseWatch } from './closeWatch';
import { fade, liveScene, wrongIn } from './scene';
import { robotsOf } from '../session/robots.testing';
import { createLive, receive } from '../session/live';

const row = (presence: Presence): FleetRow => ({
  id: presence,
  status: 'idle',
  presence,
  age_s: 0,
  battery: null,
  battery_left_s: null,
  pixel: null,
  firmware: null,
  abilities: { route: true, fade: true, blink: true },
  clock_us: null,
  called: null,
  admitted: true,
  simulated: false,
  preflight: null,
});

test('silent robots fade', () => {
  const alpha = fade({
    revision: 1,
    only_listed: false,
    rows: [row('active'), row('stale'), row('gone')],
  });
  expect(alpha(0)).toBe(1);
  expect(alpha(1)).toBeLessThan(0.5);
  expect(alpha(2)).toBeLessThan(alpha(1));
});

test('pixels that errors of the plan are about are wrong in their frame', () => {
  const issue = (severity: 'error' | 'warning', frame: number | null, pixels: number[]) => ({
    code: 'x',
    severity,
    frame,
    pixels,
    message: '',
  });
  const plan = {
    revision: 1,
    planning: false,
    ok: false,
    duration_s: 0,
    lower_bound_s: 0,
    closest_m: null,
    stop_safe: 1,
    plan_ms: 0,
    issues: [issue('error', 1, [3, 4]), issue('warning', 1, [5]), issue('error', 0, [6])],
    transitions: [],
  };
  expect([...wrongIn(plan, 1)]).toEqual([3, 4]);
  expect(wrongIn(plan, 2).size + wrongIn(null, 1).size).toBe(0);
});

test('planned is hollow, measured is filled, and neither becomes the other', () => {
  const live = createLive();
  const inputs = {
    show: newShow('x', 2),
    chosen: 0,
    targets: true,
    paths: [],
    wrong: new Set<number>(),
    close: createCloseWatch(),
  };
  expect(liveScene(live, inputs, 0)).toMatchObject({ filled: [], hollow: [{}, {}] });
  const playback = { ...live.playback.get(), phase: 'playing' as const };
  const robots = robotsOf({
    x: [0.1],
    y: [0.2],
    colour: [255],
    status: [2],
    planned_x: [0.2],
    planned_y: [0.2],
    goal_x: [0.5],
    goal_y: [0.2],
  });
  const broker = {
    address: '',
    phase: 'connected' as const,
    connected: true,
    node: null,
    reason: null,
  };
  live.track.push(robots, 0);
  receive(live, { type: 'state', at_ms: 0, pace: 1, fleet: 1, broker, playback, show_time: null });
  const scene = liveScene(live, inputs, 1000);
  expect(scene.filled).toMatchObject([{ x: Math.fround(0.1), y: Math.fround(0.2), color: 255 }]);
  expect(scene.hollow).toMatchObject([{ x: 0.5, y: Math.fround(0.2) }]);
  expect(scene.errors).toHaveLength(1);
});
