/**
 * Milliseconds to wait before try `n` (from 0): 250, doubled with each try up to 5000, then ± a quarter by `random`,
 * 0 to 1.
 */
export function backoff_ms(n: number, random: number): number {
  const base = Math.min(5000, 250 * 2 ** Math.min(n, 10));
  return base * (0.75 + 0.5 * random);
}
