import { expect, test } from 'vitest';
import type { Broker, FleetRow, Plan } from '../api/types.gen';
import { pinPixel, setSpares } from '../model/commands';
import { newShow } from '../model/show';
import { robotRow } from './robots.testing';
import { canGoOn, checklistOf, isReady, type Check, type Situation } from './checklist';
import { planOf } from './plan.testing';

const row = (id: string, over: Partial<FleetRow> = {}): FleetRow =>
  robotRow({ id, simulated: false, ...over });
const plan: Plan = { ...planOf(1), duration_s: 9, lower_bound_s: 8, closest_m: 0.08 };
const HERE: Broker = {
  address: 'mqtt://here',
  phase: 'connected',
  connected: true,
  node: 'mqtt://here',
  reason: null,
};
const all = (over: Partial<Situation> = {}): Situation => ({
  broker: HERE,
  show: newShow('x', 2),
  plan,
  rows: [row('a'), row('b')],
  robots: { x: new Float32Array([0, 1]) },
  ...over,
});
const of = (checks: Check[], name: Check['name']) => checks.find((c) => c.name === name);

test('all is well', () => {
  const checks = checklistOf(all());
  expect(isReady(checks)).toBe(true);
  expect(checks.map((c) => c.name)).toEqual(['broker', 'plan', 'robots', 'places', 'batteries']);
});

test('missing spare robots are said, and the show plays without them', () => {
  const checks = checklistOf(all({ show: setSpares(newShow('x', 1), 2) }));
  expect(of(checks, 'robots')).toMatchObject({
    verdict: 'warn',
    detail: '1 of 1, and 1 of 2 spare robots.',
  });
  expect([isReady(checks), canGoOn(checks)]).toEqual([false, true]);
  const enough = checklistOf(all({ show: setSpares(newShow('x', 1), 1) }));
  expect(of(enough, 'robots')).toMatchObject({ verdict: 'good', detail: '2 of 2' });
});

test('what is missing is said, and whether one can go on without', () => {
  const silent = checklistOf(all({ rows: [row('a'), row('b', { presence: 'gone' })] }));
  expect(of(silent, 'robots')?.detail).toMatch(/1 of 2 ready: 1 silent/);
  expect([isReady(silent), canGoOn(silent)]).toEqual([false, true]);
  const lost = checklistOf(all({ robots: { x: new Float32Array([0, NaN]) } }));
  expect(of(lost, 'places')?.detail).toMatch(/Unknown for b/);
  const low = checklistOf(all({ rows: [row('a'), row('b', { battery: 7 })] }));
  expect(of(low, 'batteries')).toMatchObject({ verdict: 'warn' });
  const lasts = (minutes: number) =>
    of(
      checklistOf(
        all({ rows: [row('a'), row('b', { battery: 60, battery_left_s: minutes * 60 })] }),
      ),
      'batteries',
    );
  expect(lasts(90)).toMatchObject({ verdict: 'good', detail: 'At least 60 %, 90 min.' });
  expect(lasts(4)).toMatchObject({ verdict: 'warn' });
  expect(lasts(4)?.detail).toContain('b has 60 %, 4 min. The show takes');
  const red = checklistOf(all({ plan: { ...plan, ok: false } }));
  expect([of(red, 'plan')?.verdict, canGoOn(red)]).toEqual(['bad', false]);
  expect(of(checklistOf(all({ plan: { ...plan, planning: true } })), 'plan')?.verdict).toBe('wait');
  const away: Broker = { ...HERE, phase: 'retrying', connected: false, reason: 'no route' };
  expect(canGoOn(checklistOf(all({ broker: away })))).toBe(false);
  expect(canGoOn(checklistOf(all({ show: null })))).toBe(false);
});

test('a pinned robot that is away is named', () => {
  const show = pinPixel(newShow('x', 2), 1, 'robot-that-left');
  const pins = of(checklistOf(all({ show })), 'pins');
  expect(pins?.detail).toMatch(/Pixel 1 is pinned to robot-th/);
  const here = pinPixel(newShow('x', 2), 1, 'b');
  expect(of(checklistOf(all({ show: here })), 'pins')?.verdict).toBe('good');
});
