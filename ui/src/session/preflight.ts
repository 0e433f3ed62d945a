import type { PreflightState } from '../api/types.gen';
import { capitalised } from '../base/words';

/** What robots do in a preflight, and in which round if it has several. */
export function preflightDoing({ doing, round, rounds }: PreflightState): string {
  const what = capitalised(doing ?? '');
  return rounds > 1 ? `${what} (round ${round} of ${rounds})` : what;
}

/** How a preflight ended, in a sentence. */
export function preflightVerdict({ finished, passed, named }: PreflightState): string {
  const all = passed + named;
  const robots = `${all} ${all === 1 ? 'robot' : 'robots'}`;
  if (!finished) return `The preflight ended early: ${passed} of ${robots} passed.`;
  return named === 0 ? `All ${robots} passed.` : `${passed} of ${robots} passed.`;
}
