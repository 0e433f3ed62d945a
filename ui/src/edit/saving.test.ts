import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { ShowEntry } from '../api/types.gen';
import { createDrafts } from '../model/drafts';
import { createEditor } from '../model/editor';
import { readShow } from '../model/json';
import { createSaving } from './saving';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** Replaces `fetch` by a library with the read-only show "heart"; answers the list of requests, path and version. */
function library() {
  const puts: string[] = [];
  vi.stubGlobal('fetch', (path: string, init: RequestInit) => {
    const match = (init.headers as Record<string, string>)['If-Match'];
    puts.push(`${path} ${match}`);
    const isExample = path === '/api/shows/heart';
    const entry: Partial<ShowEntry> = {
      name: 'heart 2',
      etag: `"${puts.length}"`,
      copy_of: isExample ? 'example' : null,
    };
    return Promise.resolve(new Response(JSON.stringify(entry)));
  });
  return puts;
}

function shelf() {
  const things = new Map<string, string>();
  return {
    things,
    get length() {
      return things.size;
    },
    key: (index: number) => [...things.keys()][index] ?? null,
    getItem: (key: string) => things.get(key) ?? null,
    setItem: (key: string, value: string) => void things.set(key, value),
    removeItem: (key: string) => void things.delete(key),
  };
}

test('a read-only show is saved as a copy, and the copy is edited from then on', async () => {
  const puts = library();
  const storage = shelf();
  const drafts = createDrafts(storage, { tab: 'a', page: 'p', now_ms: () => 0 });
  const editor = createEditor(readShow({ name: 'Heart' }));
  const copied = vi.fn();
  const saving = createSaving(drafts, 'heart', '"example"', editor, null, copied);
  editor.change('Title', (show) => ({ ...show, name: 'Mine' }));
  await vi.advanceTimersByTimeAsync(1000);
  expect(puts).toEqual(['/api/shows/heart "example"']);
  expect(copied.mock.calls).toEqual([
    ['heart', expect.objectContaining({ name: 'heart 2', copy_of: 'example' })],
  ]);
  expect([saving.name(), saving.saver.state.get().name, saving.saver.etag()]).toEqual([
    'heart 2',
    'saved',
    '"1"',
  ]);
  // Undo still knows what was done before there was a copy, and goes to the copy.
  expect(editor.undo()).toBe('Title');
  saving.keeper.flush();
  const [draft] = [...storage.things.values()].map((text) => JSON.parse(text) as object);
  expect(draft).toMatchObject({ name: 'heart 2', etag: '"1"' });
  await vi.advanceTimersByTimeAsync(1000);
  expect(puts).toEqual(['/api/shows/heart "example"', '/api/shows/heart%202 "1"']);
  expect(copied).toHaveBeenCalledTimes(1);
});
