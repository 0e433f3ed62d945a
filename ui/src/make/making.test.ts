import { readFileSync } from 'node:fs';
import { beforeAll, expect, test, vi } from 'vitest';
import { initSync, list, look, make } from '../generated/browser';
import { newShow, type Show } from '../model/show';
import { draftOf, newDraft, sourceOf, type Draft } from './draft';
import { pixelsOf } from './frame';
import { createMaker, type Maker, type WorkerLike } from './maker';
import { createMaking } from './making';
import { reply } from './protocol';
import { verdictOf } from './verdict';

beforeAll(() => {
  initSync({ module: readFileSync(new URL('../generated/browser_bg.wasm', import.meta.url)) });
});

/** The real module on this thread, behind the same protocol. */
function realMaker(): Maker {
  return createMaker(() => {
    const worker: WorkerLike = {
      onmessage: null,
      onerror: null,
      postMessage: (ask) =>
        void Promise.resolve().then(() =>
          worker.onmessage?.({ data: reply({ make, list, look }, ask) } as MessageEvent),
        ),
      terminate: () => undefined,
    };
    return worker;
  });
}

const noFile = () => Promise.reject<Uint8Array>(new Error('There is no file.'));

function begin(fields: Partial<Draft>, robots = 30, show: Show = newShow('x', robots)) {
  const [frame] = show.frames;
  if (!frame) throw new Error('There is no frame.');
  const draft = { ...newDraft('text'), ...fields };
  return createMaking(realMaker(), { show, frame, robots, draft, moved: [], fileOf: noFile });
}

test('a word is made quickly while it is typed, and fully at rest', async () => {
  const making = begin({});
  expect(making.made.get().answer).toBeNull();
  making.change({ text: 'H' });
  making.change({ text: 'HI' });
  await vi.waitFor(() => expect(making.made.get().shown?.pixels).toHaveLength(30));
  await vi.waitFor(() => expect(making.made.get().isFull).toBe(true));
  const answer = making.made.get().answer;
  expect(answer && verdictOf(answer, 30)).toEqual({ tone: 'good', text: 'Readable' });
  const done = await making.complete();
  expect(done?.source.settings).toMatchObject({ text: 'HI' });
  const parts = new Set(pixelsOf(done?.answer ?? never()).map((pixel) => pixel.part?.name));
  expect(parts.size).toBe(2);
});

const never = (): never => {
  throw new Error('There is no answer.');
};

test('using it at once waits for the full result', async () => {
  const making = begin({ text: 'A' });
  expect((await making.complete())?.answer.pixels).toHaveLength(30);
  expect(making.made.get().isFull).toBe(true);
});

test('too few robots: the verdict says how many would do', async () => {
  const making = begin({ text: 'HELLO' }, 12);
  const done = await making.complete();
  expect(done && verdictOf(done.answer, 12).text).toMatch(/^Hard to read: \d+ robots would do$/);
});

test('an error is said, and the last picture stays', async () => {
  const making = begin({ tab: 'shape', shape: 'heart' });
  await making.complete();
  making.change({ shape: 'cloud' });
  expect(await making.complete()).toBeNull();
  const { answer, shown } = making.made.get();
  expect(answer?.error?.code).toBe('unknown-shape');
  expect(shown?.pixels).toHaveLength(30);
  expect(answer && verdictOf(answer, 30).tone).toBe('bad');
});

test('a file that cannot be fetched is an error that says why', async () => {
  const file = { hash: '0'.repeat(64), name: 'a.svg', kind: 'svg' } as const;
  const making = begin({ tab: 'file', file });
  expect(await making.complete()).toBeNull();
  expect(making.made.get().answer?.error?.message).toBe('There is no file.');
});

test('the module knows fonts, shapes and files', async () => {
  const maker = realMaker();
  const { fonts, shapes } = await maker.list();
  expect(fonts.map((font) => font.name)).toContain('lato');
  expect(shapes.find((shape) => shape.name === 'star')?.count).toBe(5);
  const file = await maker.look(new TextEncoder().encode('<svg/>'));
  expect(file).toMatchObject({ kind: 'svg', error: null });
});

test('a source becomes a draft and the same source again', () => {
  const sources = [
    sourceOf({ ...newDraft('text'), text: 'HI', size_m: 1.5, color: 0x00ff00, style: 'lines' }),
    sourceOf({ ...newDraft('shape'), shape: 'star', shapeNumbers: { count: 7 }, turn: 0.5 }),
    sourceOf({ ...newDraft('text'), text: 'A', kept: { letter_gap: 0.2, align: 'left' } }),
  ];
  for (const source of sources) expect(source && sourceOf(draftOf(source))).toEqual(source);
  expect(sourceOf(newDraft('text'))).toBeNull();
  expect(sourceOf(newDraft('file'))).toBeNull();
});

test('the box of a source becomes its size and its middle', () => {
  const source = sourceOf({ ...newDraft('text'), text: 'HI' }) ?? never();
  const draft = draftOf({ ...source, box: { min: [-1, 0], max: [1, 0.5] } });
  expect(draft.size_m).toBe(2);
  expect(draft.center).toEqual({ x: 0, y: 0.25 });
});
