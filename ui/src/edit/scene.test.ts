import { expect, test } from 'vitest';
import { addFrame, placePixels, setFrames } from '../model/commands';
import { firstState } from '../model/editorState';
import { newShow } from '../model/show';
import { isSameOnStage } from './scene';

const show = addFrame(addFrame(newShow('x', 3), 0), 1);
const state = firstState(show, 1);

test('times of frames are not on the stage; pixels, selection and floor are', () => {
  const timed = { ...state, show: setFrames(show, [0, 1], { airTime_s: 9, transition_s: 8 }) };
  expect(isSameOnStage(state, timed)).toBe(true);
  const moved = { ...state, show: placePixels(show, 2, new Map([[0, { x: 0, y: 0 }]])) };
  expect(isSameOnStage(state, moved)).toBe(false);
  expect(isSameOnStage(state, { ...state, selection: new Set([1]) })).toBe(false);
  expect(isSameOnStage(state, { ...state, frame: 0 })).toBe(false);
  const wider = { ...state, show: { ...show, stage: { ...show.stage, width_m: 9 } } };
  expect(isSameOnStage(state, wider)).toBe(false);
});
