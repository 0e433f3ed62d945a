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
  expect([fleet(1), incidents, fleet(2)].map(held.hold)).toEqual([true, false, true]);
  hidden = false;
  expect(held.release()).toEqual([fleet(2)]);
  expect(held.release()).toEqual([]);
});

test('a newer message that is shown replaces one that was held', () => {
  let hidden = true;
  const held = createHeldMessages(() => hidden);
  held.hold(fleet(1));
  hidden = false;
  expect(held.hold(fleet(2))).toBe(false);
  expect(held.release()).toEqual([]);
});
