import { afterEach, expect, test, vi } from 'vitest';
import { realMaker } from '../make/realMaker.testing';
import { newShow } from '../model/show';
import { fitShow, withPixels } from './fitting';

afterEach(() => vi.unstubAllGlobals());

/** Replaces `fetch` by a server that answers with what it got, so that no files are added to a show. */
const serve = () =>
  vi.stubGlobal('fetch', async (_: string, init?: RequestInit) =>
    Promise.resolve(new Response(init?.body)),
  );

test('a show is fitted to fewer and to more robots, and keeps what it is otherwise', async () => {
  serve();
  const at = (n: number) => ({ x: Math.cos(n / 5), y: Math.sin(n / 5) });
  const [maker, rows] = [realMaker(), newShow('x', 30)];
  const frames = rows.frames.map((frame) => ({
    ...frame,
    pixels: frame.pixels.map((pixel) => ({ ...pixel, ...at(pixel.id) })),
  }));
  const show = { ...rows, frames };
  for (const robots of [12, 45]) {
    const fitted = await fitShow(maker, show, robots);
    expect(fitted.show.frames.map(({ pixels }) => pixels.length)).toEqual([robots]);
    expect(fitted.show.frames[0]?.key).toBe(show.frames[0]?.key);
    expect({ ...fitted.show, frames: [] }).toEqual({ ...show, frames: [] });
  }
});

test('more robots than find room are an error that says so', async () => {
  serve();
  await expect(fitShow(realMaker(), newShow('x', 30), 5_000)).rejects.toThrow(/robots/);
  const grown = await fitShow(realMaker(), newShow('x', 30), 45);
  expect(grown.show.frames[0]?.pixels).toHaveLength(45);
});

test('a show that changed its frames meanwhile stays as it is', () => {
  const show = newShow('x', 3);
  expect(withPixels(show, { ...show, frames: [] })).toBe(show);
});
