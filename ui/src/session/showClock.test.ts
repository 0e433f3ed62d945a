import { expect, test } from 'vitest';
import { createShowClock } from './showClock';

test('the position goes on between messages, however late some of them are', () => {
  const clock = createShowClock();
  let noise = 7;
  for (let i = 0; i < 200; i++) {
    noise = (noise * 16807) % 2147483647;
    const [sent_ms, delay_ms] = [1000 + 50 * i, 2 + (noise % 40)];
    // The clock of this screen is 5,000 ms ahead of the server's.
    const now_ms = sent_ms + 5000 + delay_ms;
    clock.hear(sent_ms, { show_s: (sent_ms - 1000) / 1000, runs: true }, now_ms);
    const true_s = (now_ms - 6000) / 1000;
    if (i > 20) expect(Math.abs((clock.position_s(now_ms) ?? 0) - true_s)).toBeLessThan(0.005);
  }
});

test('a show that stands, is over or is not heard of has no position', () => {
  const clock = createShowClock();
  expect(clock.position_s(0)).toBe(null);
  clock.hear(100, { show_s: 3, runs: true }, 100);
  expect(clock.position_s(150)).toBeCloseTo(3.05);
  clock.hear(200, { show_s: 3.1, runs: false }, 200);
  expect(clock.position_s(210)).toBe(null);
  clock.hear(300, { show_s: 3.1, runs: true }, 300);
  expect(clock.position_s(2301)).toBe(null);
  clock.hear(400, null, 2400);
  expect(clock.position_s(2400)).toBe(null);
});

test('a server that began anew is believed at once', () => {
  const clock = createShowClock();
  clock.hear(100_000, { show_s: 1, runs: true }, 100_000);
  clock.hear(10, { show_s: 0, runs: true }, 100_500);
  expect(clock.position_s(100_600)).toBeCloseTo(0.1);
});
