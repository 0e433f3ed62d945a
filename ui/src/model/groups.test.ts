import { expect, test } from 'vitest';
import { createArrowTool } from './arrowTool';
import { addFrame, makeFrames } from './commands';
import { createEditor } from './editor';
import { groupOf, groupPixels, groupsOf, ungroupPixels, wholeGroups } from './groups';
import { readShow, writeShow } from './json';
import { newShow, type Show } from './show';
import type { Touch } from './tool';

/** Pixels 0 to 4 at x = 0, 0.5, 1, 1.5, 2 and y = 0; 0, 1 and 2 are a group. */
function grouped(): Show {
  const show = newShow('x', 5);
  const frames = show.frames.map((f) => ({
    ...f,
    pixels: f.pixels.map((p, i) => ({ ...p, x: i * 0.5, y: 0 })),
  }));
  return groupPixels({ ...show, frames }, 0, new Set([0, 1, 2]));
}

const groups = (show: Show) => show.frames[0]?.pixels.map((p) => p.group);

test('pixels are grouped, join another group, and are ungrouped', () => {
  const show = grouped();
  expect(groups(show)).toEqual(['Group 1', 'Group 1', 'Group 1', null, null]);
  expect([...wholeGroups(show.frames[0], [1, 4])].sort()).toEqual([0, 1, 2, 4]);
  expect(groupOf(show.frames[0]?.pixels.slice(0, 3) ?? [])).toBe('Group 1');
  expect(groupOf(show.frames[0]?.pixels ?? [])).toBeNull();
  const again = groupPixels(show, 0, new Set([1, 2, 3]));
  expect(groups(again)).toEqual([null, 'Group 2', 'Group 2', 'Group 2', null]);
  expect(groupsOf(again.frames[0]?.pixels ?? [])).toEqual(['Group 2']);
  expect(groups(ungroupPixels(again, 0, [3]))).toEqual([null, null, null, null, null]);
  expect(groupPixels(show, 0, new Set([4]))).toBe(show);
  expect(ungroupPixels(show, 0, [4])).toBe(show);
});

test('groups are kept in the file, which is then of version 2, and in added frames', () => {
  const document = writeShow(grouped()) as { lightbots: number; frames: { pixels: unknown[] }[] };
  expect(document.lightbots).toBe(2);
  expect(document.frames[0]?.pixels[0]).toMatchObject({ id: 0, group: 'Group 1' });
  expect(groups(readShow(document))).toEqual(groups(grouped()));
  expect((writeShow(newShow('x', 2)) as { lightbots: number }).lightbots).toBe(1);
  expect(addFrame(grouped(), 0).frames[1]?.pixels[1]?.group).toBe('Group 1');
});

test('of a frame that is made anew, only pixels that were moved by hand stay in their groups', () => {
  const show = grouped();
  const [frame] = show.frames;
  const source = {
    ...({ kind: 'shape', asset: null, seed: 1, box: null, series: null, moment_s: null } as const),
    moved: [0, 1],
    settings: {},
  };
  const pixels = frame?.pixels.map((p) => ({ ...p, group: null })) ?? [];
  const made = makeFrames(show, frame?.key ?? 0, [{ source, pixels }], {});
  expect(groups(made)).toEqual(['Group 1', 'Group 1', null, null, null]);
});

test('a click means the group, Alt or a double click one pixel', () => {
  const editor = createEditor(grouped());
  const tool = createArrowTool({
    grid_m: () => 0,
    neighbours: () => false,
    lengthText: String,
  });
  const click = (x: number, over: Partial<Touch> = {}) => {
    const usual = { reach_m: 0.03, shift: false, alt: false, ctrl: false, again: false };
    const touch = { at: { x, y: 0 }, ...usual, ...over };
    tool.down(editor, touch);
    tool.up(editor, touch);
    return [...editor.state.get().selection].sort().join();
  };
  expect(click(0.5)).toBe('0,1,2');
  expect(click(0.5, { again: true })).toBe('1');
  expect(click(0.5)).toBe('0,1,2');
  expect(click(2, { shift: true })).toBe('0,1,2,4');
  expect(click(0, { shift: true })).toBe('4');
  expect(click(0, { alt: true })).toBe('0');
  expect(click(1, { alt: true, shift: true })).toBe('0,2');
});
