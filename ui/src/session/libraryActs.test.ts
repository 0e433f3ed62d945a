import { afterEach, expect, test, vi } from 'vitest';
import type { ShowEntry } from '../api/types.gen';
import { stubAddress } from './address.testing';
import { copyShow, deleteWithUndo, renameShow } from './libraryActs';
import type { Session } from './session';

let undo: () => unknown = () => undefined;
vi.mock('./notices', () => ({
  notify: () => undefined,
  notifyWithUndo: (_: string, act: () => unknown) => (undo = act),
}));

/** Replaces `fetch` by a server with the show `Future`; its file has more than its document. Saved bodies by path. */
function serve() {
  stubAddress('#/live');
  const saved = new Map<string, unknown>();
  const answer = async (path: string, init?: RequestInit) => {
    if (init?.method === 'PUT') {
      saved.set(path, init.body instanceof Blob ? await init.body.text() : init.body);
      return Response.json({ name: path } as ShowEntry);
    }
    if (path === '/api/shows') return Response.json([]);
    if (path === '/api/shows/Future') return Response.json({ known: 1 });
    if (path === '/api/shows/Future/file') return new Response('{"known":1,"glow":2}');
    return new Response('', { status: 404 });
  };
  const withDelete = (path: string, init?: RequestInit) =>
    init?.method === 'DELETE' ? new Response(null, { status: 204 }) : answer(path, init);
  vi.stubGlobal('fetch', async (path: string, init?: RequestInit) => withDelete(path, init));
  return saved;
}

afterEach(() => vi.unstubAllGlobals());

test('renaming and undoing a deletion keep what the screen does not know', async () => {
  const saved = serve();
  const session = { live: { opened: { get: () => ({ name: null }) } } } as unknown as Session;
  await renameShow(session, 'Future', 'Later');
  expect(saved.get('/api/shows/Later')).toBe('{"known":1,"glow":2}');
  await deleteWithUndo('Future', () => undefined);
  await undo();
  expect(saved.get('/api/shows/Future')).toBe('{"known":1,"glow":2}');
});

test('a copy has what the screen knows', async () => {
  const saved = serve();
  expect(await copyShow('Future', 'Copy')).toBe('Copy');
  expect(saved.get('/api/shows/Copy')).toBe('{"known":1}');
});
