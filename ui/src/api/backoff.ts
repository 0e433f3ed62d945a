/** Milliseconds to wait before try `n` (from 0): doubles from a quarter of a second to five, ± a quarter at random. */
export function backoff_ms(n: number, random: number): number {
  const base = Math.min(5000, 250 * 2 ** Math.min(n, 10));
  return base * (0.75 + 0.5 * random);
}
