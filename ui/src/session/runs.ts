import { reportAddress } from '../api/http';
import type { RunEntry } from '../api/types.gen';
import { clockText } from '../base/time';
import { createChoice } from './preferences';

const isText = (text: string | null): text is string => text !== null;

/** Start of the run with the report that the user declined, as text, milliseconds since 1970; empty: none. */
export const dismissedRun = createChoice('lightbots-run-dismissed', '', isText);

/**
 * The first run of kind `show` in `runs`. Null: there is none, it has not ended, has no report, or began at
 * `dismissed` (milliseconds since 1970, as text).
 */
export function offeredRun(runs: readonly RunEntry[], dismissed: string): RunEntry | null {
  const last = runs.find((run) => run.kind === 'show');
  if (!last?.has_report || last.ended_ms === null) return null;
  return String(last.began_ms) === dismissed ? null : last;
}

const KINDS = { show: '', frame: 'Drive to a frame of ', home: 'Home in ' } as const;

/** What a run was of. */
export const runTitle = ({ kind, show }: RunEntry) => `${KINDS[kind]}${show.trim() || 'a show'}`;

/** When a run began, and how long it took if it has ended. */
export function runTimes({ began_ms, ended_ms }: RunEntry): string {
  const began = new Date(began_ms).toLocaleString();
  return ended_ms === null ? began : `${began} · ${clockText((ended_ms - began_ms) / 1000)}`;
}

/** How a run ended. `isOn`: it is still on. */
export const runOutcome = ({ outcome }: RunEntry, isOn: boolean) =>
  outcome ?? (isOn ? 'It is on.' : 'Its program ended before it did.');

/** Links of a run's report: to read it in a tab of its own, and to save it. */
export const reportLinks = ({ number }: RunEntry) => ({
  read: { href: reportAddress(number), target: '_blank', rel: 'noopener' },
  save: { href: reportAddress(number), download: `lightbots-run-${number}.html` },
});
