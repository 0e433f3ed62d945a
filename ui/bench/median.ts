/** Median duration of some rounds, milliseconds. */
export async function medianOf(rounds: number, once: (round: number) => unknown): Promise<number> {
  const times: number[] = [];
  for (let round = 0; round < rounds; round++) {
    const before = performance.now();
    await once(round);
    times.push(performance.now() - before);
  }
  return times.sort((a, b) => a - b)[rounds >> 1] ?? NaN;
}
