import { expect, test } from 'vitest';
import { createLive } from '../session/live';
import { robotRow, robotsOf } from '../session/robots.testing';
import { createLiveLights } from './liveLights';

test('robots that are gone are not drawn, and nothing new is drawn while all stand', () => {
  const live = createLive();
  const lightsAt = createLiveLights(live);
  expect(lightsAt(0).dots).toEqual([]);
  live.track.push(robotsOf({ x: [0, 0.5] }), 0);
  live.fleet.set({ revision: 1, only_listed: false, rows: [robotRow(), robotRow()] });
  expect(lightsAt(10).dots).toHaveLength(2);
  const still = lightsAt(2000);
  expect(lightsAt(3000)).toBe(still);
  live.fleet.set({
    revision: 2,
    only_listed: false,
    rows: [robotRow(), robotRow({ presence: 'gone' })],
  });
  expect(lightsAt(4000).dots.map(({ x }) => x)).toEqual([0]);
});

test('without a connection the last lights stay', () => {
  const live = createLive();
  const lightsAt = createLiveLights(live);
  live.track.push(robotsOf({ x: [0.25] }), 0);
  lightsAt(0);
  live.link.set('lost');
  expect(lightsAt(60_000).dots).toMatchObject([{ x: 0.25, color: 0xff0000 }]);
});
