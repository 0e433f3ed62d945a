import { expect, test } from 'vitest';
import type { ToScreen } from '../api/types.gen';
import { createHeldMessages } from './heldMessages';

const fleet = (revision: number): ToScreen => ({
  type: 'fleet',
  revision,
  only_listed: false,
  rows: [],
});
const incidents: ToScreen = { type: 'incidents', list: [] };

test('a hidden page holds the newest message of a kind until it is seen', () => {
  let hidden = true;
  const held = createHeldMessages(() => hidden);
  const holds = [fleet(1), fleet(2), incidents, fleet(3)].map((one, i) => held.hold(one, 100 * i));
  // The first one is shown: a page that is opened behind others is not empty.
  expect(holds).toEqual([false, true, false, true]);
  hidden = false;
  expect(held.release()).toEqual([fleet(3)]);
  expect(held.release()).toEqual([]);
});

test('a hidden page is brought up to date now and then', () => {
  const held = createHeldMessages(() => true);
  const holds = [0, 5_000, 9_999, 10_000, 15_000].map((now_ms, i) => held.hold(fleet(i), now_ms));
  expect(holds).toEqual([false, true, true, false, true]);
});

test('a newer message that is shown replaces one that was held', () => {
  let hidden = true;
  const held = createHeldMessages(() => hidden);
  held.hold(fleet(0), 0);
  held.hold(fleet(1), 100);
  hidden = false;
  expect(held.hold(fleet(2), 200)).toBe(false);
  expect(held.release()).toEqual([]);
});
