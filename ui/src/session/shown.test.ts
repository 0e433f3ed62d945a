import { afterEach, expect, test, vi } from 'vitest';
import type { ShowEntry } from '../api/types.gen';
import { stubAddress } from './address.testing';
import { createLive, receive } from './live';
import { openShow } from './openShow';
import { createShown } from './shown';

/** A screen at an address, and a server whose library has the shows `A` and `C`. */
function setup(hash: string) {
  const { address, go } = stubAddress(hash);
  const fetched = vi.fn((path: string) => {
    if (path === '/api/shows') return Promise.resolve(Response.json([entry('A'), entry('C')]));
    const isThere = path === '/api/shows/A' || path === '/api/shows/C';
    return Promise.resolve(
      isThere
        ? Response.json({ name: path }, { headers: { etag: '"7"' } })
        : new Response('There is no such show.', { status: 404 }),
    );
  });
  vi.stubGlobal('fetch', fetched);
  const live = createLive();
  live.link.set('open');
  let revision = 0;
  const open = (name: string) =>
    receive(live, {
      type: 'show',
      revision: ++revision,
      name,
      etag: '"1"',
      read_only: null,
      document: {},
    });
  return { address, go, fetched, live, open, shown: createShown(live) };
}

const entry = (name: string) => ({ name, read_only: null }) as ShowEntry;

afterEach(() => vi.unstubAllGlobals());

test('an address without a name gets that of the open show, and keeps it when another one is opened', () => {
  const { address, open, shown, fetched } = setup('#/edit');
  open('A');
  expect([shown.get().name, address.hash]).toEqual(['A', '#/edit/A']);
  open('B');
  expect([shown.get().name, address.hash]).toEqual(['A', '#/edit/A']);
  expect(fetched, 'the show is already here').not.toHaveBeenCalled();
});

test('a show that is not open comes from the library', async () => {
  const { open, shown } = setup('#/edit/C');
  open('A');
  await vi.waitFor(() => expect(shown.get().show).not.toBeNull());
  expect(shown.get()).toMatchObject({ name: 'C', etag: '"7"', failure: null });
});

test('a show that is nowhere is a failure in words, and the open show is a way out', async () => {
  const { go, open, shown } = setup('#/edit/gone%20show');
  open('A');
  await vi.waitFor(() => expect(shown.get().failure).toBe('There is no such show.'));
  expect(shown.get().name).toBe('gone show');
  go('#/edit');
  expect(shown.get()).toMatchObject({ name: 'A', failure: null });
});

test('a show that this screen opens is shown here, also if another one is announced before', async () => {
  const { address, live, open, shown } = setup('#/edit/A');
  open('A');
  const ask = (...announced: string[]) => {
    announced.slice(0, -1).forEach(open);
    setTimeout(() => announced.slice(-1).forEach(open));
    return () => Promise.resolve({ id: 1, ok: true, error: null, choice: null });
  };
  // A save of the show that was open is announced first.
  expect(await openShow({ live, ask: ask('A', 'B') }, 'B')).toBe(true);
  expect([shown.get().name, address.hash]).toEqual(['B', '#/edit/B']);
  vi.useFakeTimers();
  const other = openShow({ live, ask: ask('C') }, 'A');
  await vi.advanceTimersByTimeAsync(5_000);
  vi.useRealTimers();
  expect(await other).toBe(false);
  expect(shown.get().name).toBe('B');
});
