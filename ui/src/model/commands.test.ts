import { expect, test } from 'vitest';
import * as c from './commands';
import { marksOf } from './marks';
import { newShow, type Show } from './show';
import { snap } from './snap';

const names = (show: Show) => show.frames.map((f) => f.name).join(' ');
function three(): Show {
  let show = c.addFrame(c.addFrame(newShow('x', 3), 0), 1);
  ['A', 'B', 'C'].forEach((name, i) => (show = c.setFrames(show, [i], { name })));
  return show;
}

test('frames are added, copied, moved and deleted; the last one stays', () => {
  expect(names(c.moveFrames(three(), [0], 3))).toBe('B C A');
  expect(names(c.moveFrames(three(), [2], -5))).toBe('C A B');
  expect(names(c.moveFrames(three(), [0], 2))).toBe('B A C');
  expect(names(c.moveFrames(three(), [2, 0], 2))).toBe('B A C');
  expect(names(c.moveFrames(three(), [1, 2], 0))).toBe('B C A');
  expect(names(c.duplicateFrames(three(), [2, 0]))).toBe('A B C A copy C copy');
  expect(names(c.deleteFrames(three(), [0, 2]))).toBe('B');
  const show = three();
  expect(c.deleteFrames(show, [0, 1, 2])).toBe(show);
});

test('a change that changes nothing is the same show', () => {
  const show = three();
  expect(c.setFrames(show, [0], { name: 'A' })).toBe(show);
  expect(c.recolour(show, 0, new Map([[0, 0xffc878]]))).toBe(show);
  expect(c.placePixels(show, 9, new Map())).toBe(show);
  expect(c.moveFrames(show, [0, 1], 2)).toBe(show);
});

test('keys tell frames apart', () => {
  const show = c.duplicateFrames(three(), [0, 1, 2]);
  expect(new Set(show.frames.map((f) => f.key)).size).toBe(6);
});

test('gradient runs along the longer side', () => {
  const pixels = newShow('x', 3).frames[0]?.pixels ?? [];
  expect([...c.gradient(pixels, 0x000000, 0xff0000).values()]).toEqual([0, 0x800000, 0xff0000]);
});

test('the fleet grows onto free places and shrinks from the highest ids', () => {
  const more = c.setFleetSize(three(), 60, 0xffffff);
  expect(more.frames.map((f) => f.pixels.length)).toEqual([60, 60, 60]);
  const frame = more.frames[0];
  if (!frame) throw new Error('no frame');
  expect(marksOf(frame.pixels, more.stage).tooClose.size).toBe(0);
  expect(c.setFleetSize(more, 2, 0).frames[0]?.pixels.map((p) => p.id)).toEqual([0, 1]);
});

test('marks: too close, off the floor, on an obstacle', () => {
  const { stage } = newShow('x', 1);
  const pixel = (id: number, x: number, y: number) => ({
    id,
    x,
    y,
    color: 0,
    robot: null,
    part: null,
    group: null,
  });
  const pixels = [pixel(0, 0, 0), pixel(1, 0.05, 0), pixel(2, 1.49, 0), pixel(3, 0.5, 0.5)];
  const obstacles = [{ kind: 'rect' as const, minX: 0.4, minY: 0.4, maxX: 0.6, maxY: 0.6 }];
  const marks = marksOf(pixels, { ...stage, obstacles });
  expect([...marks.tooClose]).toEqual([0, 1]);
  expect([...marks.offFloor]).toEqual([2, 3]);
});

test('snapping: neighbours before the grid, each axis on its own', () => {
  const options = { grid_m: 0.05, reach_m: 0.012, neighbours: [{ x: 0.51, y: 3 }] };
  const snapped = snap({ x: 0, y: 0 }, 0.505, 0.208, options);
  expect(snapped.dx).toBeCloseTo(0.51, 9);
  expect(snapped.dy).toBeCloseTo(0.2, 9);
  expect(snapped.guides).toEqual([{ axis: 'x', at: 0.51 }]);
  expect(snap({ x: 0, y: 0 }, 0.275, 0, { ...options, neighbours: [] }).dx).toBe(0.275);
});

test('a pin holds in every frame, a robot has one pixel, and freeing undoes it', () => {
  const show = three();
  const pinned = c.pinPixel(show, 1, 'r');
  expect(pinned.frames.map((f) => f.pixels[1]?.robot)).toEqual(['r', 'r', 'r']);
  expect([...c.pinsOf(c.pinPixel(pinned, 2, 'r'))]).toEqual([[2, 'r']]);
  expect(c.pinsOf(c.pinPixel(pinned, 1, null)).size).toBe(0);
  expect(c.pinPixel(pinned, 1, 'r')).toBe(pinned);
});

test('pixels of a made frame that are moved by hand are moved ones of their source', () => {
  const show = newShow('x', 3);
  const [frame] = show.frames;
  const pixels = frame?.pixels.map((p) => ({ ...p, part: { source: 0, name: 'A' } })) ?? [];
  const source = {
    kind: 'text',
    asset: null,
    seed: 1,
    box: null,
    moved: [2],
    series: null,
    moment_s: null,
    settings: { text: 'A' },
  } as const;
  const made = c.makeFrames(show, frame?.key ?? -1, [{ source, pixels }], {});
  const place = new Map([[0, { x: 0.5, y: 0.5 }]]);
  expect(c.placePixels(made, 0, place).frames[0]?.sources[0]?.moved).toEqual([0, 2]);
  expect(c.recolour(made, 0, new Map([[1, 0xff]])).frames[0]?.sources[0]?.moved).toEqual([2]);
  const same = new Map([[1, made.frames[0]?.pixels[1] ?? { x: 0, y: 0 }]]);
  expect(c.placePixels(made, 0, same)).toBe(made);
});

test('a frame that is made from a file lists the file', () => {
  const show = { ...newShow('x', 1), rest: { assets: { a: 1 } } };
  const made = c.makeFrames(show, -1, [], { b: { name: 'logo.svg' } });
  expect(made.rest.assets).toEqual({ a: 1, b: { name: 'logo.svg' } });
});

test('several pictures take the frame and new ones after it, which nothing names yet', () => {
  const before = c.addFrame(newShow('x', 1), 0);
  const [frame] = before.frames;
  const show = { ...before, frames: before.frames.map((f) => ({ ...f, id: `id${f.key}` })) };
  const source = { kind: 'shape', settings: {} } as never;
  const made = [1, 2, 3].map((n) => ({ source, pixels: [], name: `${n}`, airTime_s: n }));
  const { frames } = c.makeFrames(show, frame?.key ?? -1, made, {});
  expect(frames.map(({ name }) => name)).toEqual(['1', '2', '3', 'Frame 2']);
  expect(frames.map(({ id }) => id !== null)).toEqual([true, false, false, true]);
  expect(new Set(frames.map(({ key }) => key)).size).toBe(4);
});
