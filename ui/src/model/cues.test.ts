import { expect, test } from 'vitest';
import { deleteFrames, duplicateFrames, moveFrames } from './commands';
import { cueOf, setCue } from './cues';
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
