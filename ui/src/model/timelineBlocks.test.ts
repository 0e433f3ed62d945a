import { expect, test } from 'vitest';
import type { Plan } from '../api/types.gen';
import { addFrame, setFrames } from './commands';
import { createEditor } from './editor';
import { newShow, type Show } from './show';
import {
  blocksBetween,
  blocksOf,
  dragBlockEdge,
  isFastest,
  leadIn_s,
  plannedDrives,
  stretchBlocks,
} from './timelineBlocks';

const PLAN = {
  transitions: [
    { to: 0, duration_s: 4, least_s: 4 },
    { to: 1, duration_s: 6, least_s: 5.376 },
    { to: 2, duration_s: 3, least_s: 3 },
  ],
} as unknown as Plan;

/** Three frames of 2 s; the drive to the second is asked to take 6 s and needs 5.376 s. */
function threeFrames(): Show {
  const three = addFrame(addFrame(newShow('x', 4), 0), 1);
  return setFrames(setFrames(three, [0, 1, 2], { airTime_s: 2 }), [1], { transition_s: 6 });
}

const show = threeFrames();
const drives = plannedDrives(show, PLAN);
const blocks = blocksOf(show, drives);
const travels = (of: Show) => of.frames.map((f) => f.transition_s);
const airs = (of: Show) => of.frames.map((f) => f.airTime_s);

test('show time begins with the first air time', () => {
  expect(blocks.map((b) => [b.driveFrom_s, b.shownFrom_s, b.until_s])).toEqual([
    [-4, 0, 2],
    [2, 8, 10],
    [10, 13, 15],
  ]);
  expect(leadIn_s(blocks)).toBe(4);
  expect(blocks.map(isFastest)).toEqual([true, false, true]);
});

test('without a plan, drives take no time and have no least time', () => {
  const bare = blocksOf(show, plannedDrives(show, null));
  expect(bare.map((b) => b.until_s)).toEqual([2, 4, 6]);
  expect(bare.map((b) => b.least_s)).toEqual([null, null, null]);
  expect(travels(dragBlockEdge(show, bare, [1], 1, 'travel', 9))).toEqual([null, 6, null]);
});

test('a new travel time counts before it is planned, and never below the least', () => {
  const at = (transition_s: number | null) =>
    blocksOf(setFrames(show, [1], { transition_s }), drives)[1]?.shownFrom_s;
  expect(at(7.5)).toBe(9.5);
  expect(at(1)).toBeCloseTo(7.376, 9);
  expect(at(null)).toBeCloseTo(7.376, 9);
});

test('dragging the end of a drive stops at its least time', () => {
  expect(travels(dragBlockEdge(show, blocks, [1], 1, 'travel', 9.5))).toEqual([null, 7.5, null]);
  expect(travels(dragBlockEdge(show, blocks, [1], 1, 'travel', 2.5))).toEqual([null, null, null]);
  expect(travels(dragBlockEdge(show, blocks, [1], 1, 'travel', 7.39))).toEqual([null, 5.39, null]);
  expect(dragBlockEdge(show, blocks, [1], 1, 'travel', 8)).toBe(show);
});

test('chosen frames change alike, and the dragged edge stays under the pointer', () => {
  const longer = dragBlockEdge(show, blocks, [0, 1, 2], 1, 'air', 13);
  expect(airs(longer)).toEqual([3.5, 3.5, 3.5]);
  expect(blocksOf(longer, drives)[1]?.until_s).toBe(13);
  expect(airs(dragBlockEdge(show, blocks, [0, 2], 1, 'air', 11))).toEqual([2, 3, 2]);
  expect(airs(dragBlockEdge(show, blocks, [0], 0, 'air', -9))).toEqual([0, 2, 2]);
});

test('steps by keys', () => {
  expect(airs(stretchBlocks(show, blocks, [0, 2], 'air', 0.5))).toEqual([2.5, 2, 2.5]);
  expect(travels(stretchBlocks(show, blocks, [1, 2], 'travel', 0.5))).toEqual([null, 6.5, 3.5]);
});

test('a drag is one step of the history', () => {
  const editor = createEditor(show);
  editor.begin();
  for (const to_s of [3, 4, 5])
    editor.change('Air time', () => dragBlockEdge(show, blocks, [0], 0, 'air', to_s));
  editor.commit('Air time');
  expect(airs(editor.state.get().show)).toEqual([5, 2, 2]);
  expect(editor.undo()).toBe('Air time');
  expect(editor.state.get().show).toBe(show);
  expect(editor.undo()).toBeNull();
});

test('a stretch of time touches blocks', () => {
  expect(blocksBetween(blocks, 9, 11)).toEqual([1, 2]);
  expect(blocksBetween(blocks, 1, -9)).toEqual([0]);
  expect(blocksBetween(blocks, 20, 30)).toEqual([]);
});
