import { expect, test, vi } from 'vitest';
import type { Plan } from '../api/types.gen';
import { newFrame, newShow, type Pixel, type Show } from '../model/show';
import { newDraft } from './draft';
import { drivesText, planTo } from './drive';
import { createMaking } from './making';
import { realMaker } from './realMaker.testing';

/** A show with `counts[k]` pixels in rows in frame `k`. */
function dots(counts: readonly number[]): Show {
  const show = newShow('x', counts[0] ?? 0);
  const pixels = (count: number): Pixel[] => (newShow('x', count).frames[0]?.pixels ?? []).slice();
  return { ...show, frames: counts.map((count, k) => newFrame(`Frame ${k}`, pixels(count))) };
}

function makeIn(show: Show, index: number, text: string, robots: number) {
  const frame = show.frames[index];
  if (!frame) throw new Error('There is no frame.');
  const draft = { ...newDraft('text'), text };
  const fileOf = () => Promise.reject<Uint8Array>(new Error('There is no file.'));
  return createMaking(realMaker(), { show, frame, robots, draft, moved: [], fileOf });
}

test('the drive to a frame that is made begins at the frame before', async () => {
  const show = dots([30, 30]);
  const making = makeIn(show, 1, 'HI', 30);
  await vi.waitFor(() => expect(making.made.get().drives).not.toBeNull(), 5000);
  const { drives } = making.made.get();
  if (!drives) throw new Error('There is no plan.');
  expect(drivesText(drives)).toMatch(/^Collision-free drive of \d+\.\d s$/);
  const [drive, ...others] = planTo(drives, 0, 1).transitions;
  expect(others).toHaveLength(0);
  expect(drive?.to).toBe(1);
  const starts =
    drive?.paths.map((path) => path.start.map((value) => value.toFixed(4)).join()) ?? [];
  const before = show.frames[0]?.pixels.map(({ x, y }) => [x, y].map((v) => v.toFixed(4)).join());
  expect(starts.sort()).toEqual(before?.sort());
  making.change({ text: 'HO' });
  expect(making.made.get().drives).toBeNull();
});

test('the drive to the first frame begins at the starting places', async () => {
  const making = makeIn(dots([30, 30]), 0, 'HI', 30);
  await vi.waitFor(() => expect(making.made.get().drives).not.toBeNull(), 5000);
  const { drives } = making.made.get();
  expect(drives?.first).toBe(0);
  expect(drives?.plan.transitions[0]?.paths).toHaveLength(30);
});

test('a drive that is not collision-free is not called so', () => {
  const plan = { ok: false, transitions: [{ duration_s: 3 }] } as Plan;
  expect(drivesText({ plan, first: 0 })).toBe('No collision-free drive to this frame');
});
