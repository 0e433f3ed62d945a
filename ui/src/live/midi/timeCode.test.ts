import { expect, test } from 'vitest';
import { codeText, createTimeCode, readClock } from './timeCode';

/** The eight quarter-frame messages of a time; `rate`: index of the frame rate, 0 to 3. */
function quarters(hours: number, minutes: number, seconds: number, frames: number, rate: number) {
  const fields = [frames, seconds, minutes, hours + 32 * rate];
  return fields.flatMap((value, i) => [
    new Uint8Array([0xf1, ((2 * i) << 4) | (value & 15)]),
    new Uint8Array([0xf1, ((2 * i + 1) << 4) | (value >> 4)]),
  ]);
}

function heard(pieces: readonly Uint8Array[], every_ms = 10) {
  const code = createTimeCode();
  pieces.forEach((piece, i) => code.hear(piece, 1000 + every_ms * i));
  return code;
}

test('eight quarter frames tell the time of the last one, and the clock goes on', () => {
  const code = heard(quarters(1, 2, 3, 4, 1));
  const last_ms = 1000 + 70;
  const expected_s = 3723 + (4 + 1.75) / 25;
  expect(code.now_s(last_ms)).toBeCloseTo(expected_s, 9);
  expect(code.now_s(last_ms + 100)).toBeCloseTo(expected_s + 0.1, 9);
  expect(code.now_s(last_ms + 300)).toBeNull();
});

test('drop-frame code keeps to the clock on the wall', () => {
  const code = heard(quarters(1, 0, 0, 0, 2));
  expect(code.now_s(1070)).toBeCloseTo(3600 + 1.75 / 29.97, 1);
  const full = heard(quarters(0, 10, 0, 0, 2));
  expect(full.now_s(1070)).toBeCloseTo((17_982 + 1.75) / 29.97, 6);
});

test('lost, backward and foreign messages tell no time', () => {
  const all = quarters(0, 0, 10, 0, 3);
  expect(heard(all.filter((_, i) => i !== 3)).now_s(1070)).toBeNull();
  expect(heard([...all].reverse()).now_s(1070)).toBeNull();
  expect(
    heard([new Uint8Array(), new Uint8Array([0xf1]), new Uint8Array([0x90, 1, 2])]).now_s(1020),
  ).toBeNull();
  // After a loss the next whole time counts.
  expect(heard([...all.slice(0, 3), ...all]).now_s(1100)).toBeCloseTo(10 + 1.75 / 30, 6);
});

test('times are typed and said', () => {
  expect(readClock('01:02:03.5')).toBe(3723.5);
  expect(readClock(' 0:0:7 ')).toBe(7);
  for (const text of ['', '1:2', '24:00:00', '00:60:00', '00:00:60', 'a:b:c', '-1:00:00'])
    expect(readClock(text)).toBeNull();
  expect(codeText(3723.5)).toBe('01:02:03.5');
  expect(readClock(codeText(86_399.9))).toBeCloseTo(86_399.9, 6);
});
