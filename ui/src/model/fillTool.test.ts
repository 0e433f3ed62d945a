import { expect, test } from 'vitest';
import { createEditor } from './editor';
import { createFillTool, patchOf } from './fillTool';
import { readShow } from './json';

/** A row of four red pixels, apart from it a row of two; a green pixel above the middle between pixels 1 and 2. */
const show = readShow({
  frames: [
    {
      pixels: [0, 0.1, 0.2, 0.3, 1, 1.1]
        .map((x, id) => ({ id, place: [x, 0], color: '#ff0000' }))
        .concat([{ id: 6, place: [0.15, 0.05], color: '#00ff00' }]),
    },
  ],
});
const pixels = show.frames[0]?.pixels ?? [];
const touch = (x: number, y = 0) => ({
  at: { x, y },
  reach_m: 0.02,
  shift: false,
  alt: false,
  ctrl: false,
  again: false,
});

const coloured = (editor: ReturnType<typeof createEditor>) =>
  (editor.current()?.pixels ?? []).filter((p) => p.color === 0x0000ff).map((p) => p.id);

test('a patch is what lies together in one colour', () => {
  expect([...patchOf(pixels, 1)].sort()).toEqual([0, 1, 2, 3]);
  expect([...patchOf(pixels, 5)].sort()).toEqual([4, 5]);
  expect([...patchOf(pixels, 6)]).toEqual([6]);
});

test('a click fills the patch as one change', () => {
  const editor = createEditor(show);
  const tool = createFillTool(() => 0x0000ff);
  tool.down(editor, touch(0.1));
  tool.up(editor, touch(0.1));
  expect(coloured(editor)).toEqual([0, 1, 2, 3]);
  expect(editor.undo()).toBe('Fill');
  expect(coloured(editor)).toEqual([]);
});

test('a drag colours what it passes, and a click beside all pixels changes nothing', () => {
  const editor = createEditor(show);
  const tool = createFillTool(() => 0x0000ff);
  tool.down(editor, touch(0.1));
  tool.move(editor, touch(0.15));
  tool.move(editor, touch(0.2));
  tool.up(editor, touch(0.2));
  expect(coloured(editor)).toEqual([1, 2]);
  tool.down(editor, touch(0.6));
  tool.up(editor, touch(0.6));
  expect(coloured(editor)).toEqual([1, 2]);
  tool.down(editor, touch(0.3));
  expect(tool.cancel(editor)).toBe(true);
  expect(coloured(editor)).toEqual([1, 2]);
});
