import { expect, test } from 'vitest';
import { readShow } from '../model/json';
import { cueRows, frameText, jumpQuestion, repeatsText, wayOn, whyNoJump } from './cueRows';

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

test('frames that repeat are said in their row and above Play', () => {
  const cues = [{ name: 'Encore', frame: 'b', loop_from: 'a' }];
  const looping = readShow({ cues, frames: [{ id: 'a' }, { id: 'b' }] });
  const rows = cueRows(looping, { phase: 'ready', frame: null, next: null }, 0);
  expect(rows.map(wayOn)).toEqual(['goes on by itself', 'repeats from frame 1 until GO: Encore']);
  expect(wayOn({ index: 1, cue: '', from: 1 })).toBe('repeats until GO');
  expect(wayOn({ index: 1, cue: '', from: null })).toBe('waits for GO');
  const repeats = { first: 1, last: 3, round: 3, leaves: false };
  expect(repeatsText(repeats)).toBe('Frames 2 to 4 repeat until GO (round 3)');
  expect(repeatsText({ ...repeats, last: 1 })).toBe('Frame 2 repeats until GO (round 3)');
  expect(repeatsText({ ...repeats, leaves: true })).toBe(
    'GO was given: on after frame 4 (round 3)',
  );
});
