import { expect, test, vi } from 'vitest';
import { newShow } from '../model/show';
import { draftOf, newDraft, sourceTitle, sourcesOf, type Draft } from './draft';
import { pixelsOf } from './frame';
import { gifOf } from './gif.testing';
import { createMaking, pictureShown } from './making';
import { realMaker } from './realMaker.testing';
import { verdictOf } from './verdict';

const noFile = () => Promise.reject<Uint8Array<ArrayBuffer>>(new Error('There is no file.'));

const bytesOf = (hash: string): Promise<Uint8Array> =>
  Promise.resolve(hash === 'film' ? gifOf([0, 10, 20, 30]) : new TextEncoder().encode(SVG));

const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="9" height="9"/></svg>';

function begin(fields: Partial<Draft>, robots = 30, fileOf: typeof bytesOf = noFile) {
  const show = newShow('x', robots);
  const [frame] = show.frames;
  if (!frame) throw new Error('There is no frame.');
  const draft = { ...newDraft('text'), ...fields };
  return createMaking(realMaker(), { show, frame, robots, draft, moved: [], fileOf });
}

test('a word is made quickly while it is typed, and fully at rest', async () => {
  const making = begin({});
  expect(making.made.get().answer).toBeNull();
  making.change({ text: 'H' });
  making.change({ text: 'HI' });
  await vi.waitFor(() => expect(pictureShown(making)?.pixels).toHaveLength(30));
  await vi.waitFor(() => expect(making.made.get().isFull).toBe(true));
  const answer = making.made.get().answer;
  expect(answer && verdictOf(answer, 30)).toEqual({ tone: 'good', text: 'Readable' });
  const done = await making.complete();
  expect(done?.[0]?.source.settings).toMatchObject({ text: 'HI' });
  const parts = new Set(pixelsOf(done?.[0]?.answer ?? never()).map((pixel) => pixel.part?.name));
  expect(parts.size).toBe(2);
});

const never = (): never => {
  throw new Error('There is no answer.');
};

test('using it at once waits for the full result', async () => {
  const making = begin({ text: 'A' });
  expect((await making.complete())?.[0]?.answer.pixels).toHaveLength(30);
  expect(making.made.get().isFull).toBe(true);
});

test('too few robots: the verdict says how many would do', async () => {
  const making = begin({ text: 'HELLO' }, 12);
  await making.complete();
  const { answer } = making.made.get();
  expect(answer && verdictOf(answer, 12).text).toMatch(/^Hard to read: \d+ robots would do$/);
});

test('an error is said, and the last picture stays', async () => {
  const making = begin({ tab: 'shape', shape: 'heart' });
  await making.complete();
  making.change({ shape: 'cloud' });
  expect(await making.complete()).toBeNull();
  const { answer } = making.made.get();
  expect(answer?.error?.code).toBe('unknown-shape');
  expect(pictureShown(making)?.pixels).toHaveLength(30);
  expect(answer && verdictOf(answer, 30).tone).toBe('bad');
});

test('a file that cannot be fetched is an error that says why', async () => {
  const file = { hash: '0'.repeat(64), name: 'a.svg', kind: 'svg' } as const;
  const making = begin({ tab: 'file', files: [file] });
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
    sourcesOf({ ...newDraft('text'), text: 'HI', size_m: 1.5, color: 0x00ff00, style: 'lines' }),
    sourcesOf({ ...newDraft('shape'), shape: 'star', shapeNumbers: { count: 7 }, turn: 0.5 }),
    sourcesOf({ ...newDraft('text'), text: 'A', kept: { letter_gap: 0.2, align: 'left' } }),
    sourcesOf({ ...newDraft('text'), text: 'A', ownFont: { hash: 'f', name: 'File' } }),
    sourcesOf({
      ...newDraft('file'),
      files: [{ hash: 'f', name: 'File', kind: 'animation' }],
      moment_s: 0.8,
      way: 'outline',
      inverted: true,
    }),
  ];
  for (const [source] of sources) expect(source && sourcesOf(draftOf(source))).toEqual([source]);
  expect(sourcesOf(newDraft('text'))).toEqual([]);
  expect(sourcesOf(newDraft('file'))).toEqual([]);
});

test('a source gives its frame a name', () => {
  const title = (draft: Partial<Draft>, file: string | null = null) => {
    const [source = never()] = sourcesOf({ ...newDraft('text'), ...draft });
    return sourceTitle(source, file);
  };
  expect(title({ text: 'HELLO\nWORLD' })).toBe('HELLO WORLD');
  expect(title({ tab: 'shape', shape: 'star' })).toBe('Star');
  const files = [{ hash: 'f', name: 'moon.jpg', kind: 'picture' }] as const;
  expect(title({ tab: 'file', files }, 'moon.jpg')).toBe('Moon');
  expect(title({ tab: 'file', files })).toBe('');
});

test('the box of a source becomes its size and its middle', () => {
  const [source = never()] = sourcesOf({ ...newDraft('text'), text: 'HI' });
  const draft = draftOf({ ...source, box: { min: [-1, 0], max: [1, 0.5] } });
  expect(draft.size_m).toBe(2);
  expect(draft.center).toEqual({ x: 0, y: 0.25 });
});

test('an animation becomes several frames, and the stage shows the chosen one', async () => {
  const film = { hash: 'film', name: 'walk.gif', kind: 'animation' } as const;
  const making = begin({ tab: 'file', files: [film] }, 12, bytesOf);
  const done = (await making.complete()) ?? never();
  expect(done.length).toBeGreaterThan(1);
  expect(done.map((picture) => picture.name)).toEqual(done.map((_, n) => `walk ${n + 1}`));
  expect(done.every(({ answer }) => answer.pixels.length === 12)).toBe(true);
  expect(done[0]?.source).toMatchObject({ kind: 'animation', series: 'walk', moment_s: 0 });
  const total_s = done.reduce((sum, { airTime_s }) => sum + (airTime_s ?? 0), 0);
  expect(total_s).toBeGreaterThan(0);
  making.at.set(1);
  expect(pictureShown(making)).toEqual(done[1]?.answer);
  const { answer } = making.made.get();
  expect(answer && verdictOf(answer, 12).text).toContain(`${done.length} frames`);
});

test('several files become a frame each', async () => {
  const files = ['a.svg', 'b.svg'].map((name) => ({ hash: name, name, kind: 'svg' }) as const);
  const done = (await begin({ tab: 'file', files }, 10, bytesOf).complete()) ?? never();
  expect(done.map(({ name }) => name)).toEqual(['a', 'b']);
  expect(done.map(({ source }) => source.asset)).toEqual(['a.svg', 'b.svg']);
});
