import { expect, test } from 'vitest';
import { createPlayer, type SoundOut } from './player';

/** A sound device with a clock that runs `fast` times as fast as the page's; sound is heard 50 ms after it is made. */
function device(fast = 1) {
  let at_ms = 0;
  let sound: { at_s: number; from_s: number; rate: number } | null = null;
  let starts = 0;
  const clock_s = () => (at_ms / 1000) * fast;
  const heard = () => clock_s() - 0.05;
  const out: SoundOut = {
    heard_s: () => heard(),
    made_s: clock_s,
    start(at_s, from_s) {
      expect(at_s).toBeGreaterThan(clock_s());
      const mine = { at_s, from_s, rate: 1 };
      sound = mine;
      starts++;
      return {
        setRate(rate) {
          mine.from_s += (heard() - mine.at_s) * mine.rate;
          mine.at_s = heard();
          mine.rate = rate;
        },
        stop: () => {
          if (sound === mine) sound = null;
        },
      };
    },
  };
  return {
    out,
    starts: () => starts,
    to: (ms: number) => (at_ms = ms),
    /** Position of the file that is heard now, seconds; null: silence. */
    position_s: () =>
      sound && heard() >= sound.at_s ? sound.from_s + (heard() - sound.at_s) * sound.rate : null,
  };
}

/** Plays a show at `position` for each moment, seconds; answers how far the heard sound is ahead of it, seconds. */
function played(position: (at_s: number) => number | null, lasts_s: number, fast = 1) {
  const { out, to, position_s, starts } = device(fast);
  const player = createPlayer(out, 1000);
  const errors: { at_s: number; error_s: number }[] = [];
  for (let ms = 0; ms <= lasts_s * 1000; ms += 50) {
    to(ms);
    const wanted = position(ms / 1000);
    player.follow(wanted, ms);
    const is = position_s();
    if (wanted !== null && is !== null) errors.push({ at_s: ms / 1000, error_s: is - wanted });
  }
  return { errors, starts: starts() };
}
const worst = (errors: { error_s: number }[]) =>
  Math.max(...errors.map((e) => Math.abs(e.error_s)));

test('sound keeps to the show for minutes on a device whose clock is 200 ppm fast, without a jump', () => {
  const { errors, starts } = played((t) => 10 + t, 300, 1.0002);
  expect(errors.length).toBeGreaterThan(5900);
  expect(worst(errors)).toBeLessThan(0.004);
  expect(starts).toBe(1);
});

test('sound stops with the show, and goes on with it', () => {
  const position = (t: number) => (t < 5 ? t : t < 8 ? null : t - 3);
  const { errors, starts } = played(position, 20);
  expect(worst(errors)).toBeLessThan(0.003);
  expect(starts).toBe(2);
  expect(errors.some((e) => e.at_s > 8.2 && e.at_s < 8.4)).toBe(true);
});

test('sound waits for a show that has not begun', () => {
  const { errors, starts } = played((t) => t - 4, 10);
  expect(errors[0]?.at_s).toBeCloseTo(4.05, 1);
  expect(worst(errors)).toBeLessThan(0.003);
  expect(starts).toBe(1);
});

test('after a jump of the show sound begins anew, after a small error it hurries', () => {
  const jumped = played((t) => (t < 5 ? t : t + 30), 10);
  expect(jumped.starts).toBe(2);
  expect(worst(jumped.errors.filter((e) => e.at_s > 5.3))).toBeLessThan(0.003);
  const late = played((t) => (t < 5 ? t : t + 0.02), 20);
  expect(late.starts).toBe(1);
  expect(worst(late.errors.filter((e) => e.at_s > 14))).toBeLessThan(0.004);
});

test('music that is over does not start, and nothing starts while the device is not known', () => {
  const { out, starts } = device();
  createPlayer(out, 10).follow(11, 0);
  createPlayer({ ...out, heard_s: () => null }, 10).follow(1, 0);
  expect(starts()).toBe(0);
});
