import { expect, test } from 'vitest';
import { readShow } from '../model/json';
import { cueRows, frameText, jumpQuestion, whyNoJump } from './cueRows';

const show = readShow({
  cues: [{ name: 'Curtain', frame: 'b' }],
  frames: [{ name: 'One' }, { id: 'b', air_time_s: 2 }, { name: 'Three' }],
});
const places = (...of: Parameters<typeof cueRows>) => cueRows(...of).map((row) => row.place);

test('the frame that plays and the next one are marked; without a show it is the chosen one', () => {
  expect(places(show, { phase: 'playing', frame: 1, next: 0 }, 2)).toEqual(['next', 'now', null]);
  expect(places(show, { phase: 'paused', frame: 2, next: null }, 0)).toEqual([null, null, 'now']);
  expect(places(show, { phase: 'ready', frame: null, next: null }, 2)).toEqual([
    null,
    null,
    'next',
  ]);
});

test('a row says how its frame is left', () => {
  const rows = cueRows(show, { phase: 'ready', frame: null, next: null }, 0);
  expect(rows.map((row) => row.cue)).toEqual([null, 'Curtain', null]);
  expect(rows[1]).toMatchObject({ index: 1, name: '', air_s: 2 });
});

test('frames are named by number and name', () => {
  expect([0, 1, null, 9].map((index) => frameText(show.frames, index))).toEqual([
    '1 One',
    'Frame 2',
    '–',
    '–',
  ]);
  expect(jumpQuestion(show.frames, 2, true)).toBe('Go to frame 3, Three?');
  expect(jumpQuestion(show.frames, 1, false)).toBe('Play from frame 2?');
});

test('robots that drive are not sent elsewhere', () => {
  expect(whyNoJump({ phase: 'playing', may_jump: true }, true)).toBeNull();
  expect(whyNoJump({ phase: 'playing', may_jump: false }, true)).toMatch(/pause/);
  expect(whyNoJump({ phase: 'ready', may_jump: false }, true)).toBeNull();
  expect(whyNoJump({ phase: 'ready', may_jump: false }, false)).toMatch(/connection/);
  expect(whyNoJump({ phase: 'preview', may_jump: false }, true)).not.toBeNull();
});
