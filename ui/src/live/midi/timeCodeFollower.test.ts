import { expect, test, vi } from 'vitest';
import { createTimeCodeFollower, type FollowedShow } from './timeCodeFollower';

const READY: FollowedShow = { isReady: true, isPlaying: false, waits: false, show_s: null };
const at = (show_s: number | null): FollowedShow => ({
  ...READY,
  isReady: false,
  isPlaying: true,
  show_s,
});

function setting() {
  const acts = { play: vi.fn(), pause: vi.fn(), say: vi.fn() };
  const follower = createTimeCodeFollower(acts);
  let now_ms = 0;
  const step = (code_s: number | null, show: FollowedShow) =>
    follower.step(code_s, 100, show, (now_ms += 50));
  return { ...acts, step };
}

test('the show is played once when the code comes to its start', () => {
  const { play, step } = setting();
  step(99.9, READY);
  step(99.98, READY);
  expect(play).not.toHaveBeenCalled();
  step(100.03, READY);
  step(100.08, READY);
  expect(play).toHaveBeenCalledTimes(1);
});

test('code that begins after the start, or jumps over it, plays nothing', () => {
  const { play, step } = setting();
  step(100.2, READY);
  step(100.25, READY);
  step(90, READY);
  step(120, READY);
  expect(play).not.toHaveBeenCalled();
});

test('a jump of the code pauses the show, and drift below half a second does not', () => {
  const { pause, say, step } = setting();
  step(100, at(-3));
  step(103, at(0.1));
  for (let i = 1; i < 100; i++) step(103 + 0.05 * i, at(0.1 + 0.049 * i));
  expect(pause).not.toHaveBeenCalled();
  step(112, at(5));
  expect(pause).toHaveBeenCalledTimes(1);
  expect(say.mock.calls[0]?.[0]).toMatch(/Time code is 4\.\d s ahead of the show/);
  // After the pause the show goes on from where it is.
  step(112.1, { ...READY, isReady: false });
  step(120, at(5.1));
  step(120.05, at(5.15));
  expect(pause).toHaveBeenCalledTimes(1);
});

test('after GO the code counts anew', () => {
  const { pause, step } = setting();
  step(103, at(0.1));
  for (let i = 0; i < 100; i++) step(103 + 0.05 * i, { ...at(null), waits: true });
  step(108.05, at(0.15));
  step(108.1, at(0.2));
  expect(pause).not.toHaveBeenCalled();
});

test('code that stops pauses the show', () => {
  const { pause, say, step } = setting();
  step(103, at(0.1));
  for (let i = 0; i < 9; i++) step(null, at(0.15));
  expect(pause).not.toHaveBeenCalled();
  for (let i = 0; i < 5; i++) step(null, at(0.6));
  expect(pause).toHaveBeenCalledTimes(1);
  expect(say).toHaveBeenCalledWith('Time code has stopped: the show is paused.');
});

test('a show without code is left alone', () => {
  const { pause, step } = setting();
  for (let i = 0; i < 100; i++) step(null, at(i));
  expect(pause).not.toHaveBeenCalled();
});
