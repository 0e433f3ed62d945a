import { expect, test } from 'vitest';
import { deleteFrames, duplicateFrames, moveFrames } from './commands';
import { cueOf, goOf, loopFrom, setCue, setLoop } from './cues';
import { readShow, writeShow } from './json';

const show = readShow({ frames: [{ name: 'A' }, { name: 'B', id: 'f1' }, { name: 'C' }] });
const cues = (of: typeof show) => of.frames.map((frame) => cueOf(of, frame));

test('a frame gets a cue, a name for it, and loses it', () => {
  const waiting = setCue(show, [0, 1], '');
  expect(cues(waiting)).toEqual(['', '', null]);
  const named = setCue(waiting, [1], 'Curtain');
  expect(cues(named)).toEqual(['', 'Curtain', null]);
  expect(named.frames[0]?.id, 'an id that no frame has').toBe('f2');
  expect(writeShow(named)).toMatchObject({
    lightbots: 2,
    cues: [
      { name: '', frame: 'f2' },
      { name: 'Curtain', frame: 'f1' },
    ],
  });
  expect(setCue(named, [1], 'Curtain')).toBe(named);
  expect(setCue(named, [0, 1], null).rest).toEqual({});
});

test('a cue goes where its frame goes; copies have none', () => {
  const named = setCue(show, [1], 'Curtain');
  expect(cues(moveFrames(named, [1], 0))).toEqual(['Curtain', null, null]);
  expect(cues(duplicateFrames(named, [1]))).toEqual([null, 'Curtain', null, null]);
  expect(deleteFrames(named, [1]).rest).toEqual({});
  expect(cues(deleteFrames(named, [0]))).toEqual(['Curtain', null]);
});

test('cues at a moment stay as they are', () => {
  const timed = readShow({ cues: [{ name: 'Later', at_s: 9 }], frames: [{}, {}] });
  const both = setCue(timed, [0], '');
  expect(both.rest.cues).toEqual([
    { name: 'Later', at_s: 9 },
    { name: '', frame: 'f1' },
  ]);
  expect(deleteFrames(both, [0]).rest.cues).toEqual([{ name: 'Later', at_s: 9 }]);
});

const looping = setLoop(setCue(show, [2], 'Encore'), 2, 0);
const loops = (of: typeof show) => of.frames.map((_, index) => loopFrom(of, index));

test('frames repeat until GO, or the last of them waits', () => {
  expect(loops(looping)).toEqual([null, null, 0]);
  expect(looping.frames.map((_, index) => goOf(looping, index))).toEqual([null, null, 'repeats']);
  const [first, , last] = looping.frames;
  expect(writeShow(looping)).toMatchObject({
    cues: [{ name: 'Encore', frame: last?.id, loop_from: first?.id }],
  });
  expect(readShow(writeShow(looping)).rest.cues, 'a file keeps it').toEqual(looping.rest.cues);
  expect(loops(setCue(looping, [2], 'Bow')), 'another name').toEqual([null, null, 0]);
  expect(setLoop(looping, 2, 0)).toBe(looping);
  expect(setLoop(show, 1, 0), 'without a cue').toBe(show);
  const waiting = setLoop(looping, 2, null);
  expect(waiting.rest.cues).toEqual([{ name: 'Encore', frame: last?.id }]);
  expect(goOf(waiting, 2)).toBe('waits');
  expect(loops(setLoop(looping, 2, 2)), 'one frame').toEqual([null, null, 2]);
});

test('a loop keeps to its frames as they are moved and deleted', () => {
  expect(loops(moveFrames(looping, [1], 0))).toEqual([null, null, 1]);
  expect(loops(moveFrames(looping, [0], 3)), 'its first frame comes later').toEqual([
    null,
    'lost',
    null,
  ]);
  expect(loops(deleteFrames(looping, [1]))).toEqual([null, 0]);
  expect(loops(deleteFrames(looping, [0])), 'the next one is first').toEqual([null, 0]);
  expect(loops(deleteFrames(looping, [0, 1]))).toEqual([0]);
  expect(deleteFrames(looping, [2]).rest).toEqual({});
});
