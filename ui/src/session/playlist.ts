import { useCallback, useEffect, useState } from 'react';
import { getPlaylist } from '../api/http';
import type { PlaylistDay, PlaylistEntry, PlaylistState, PlaylistToday } from '../api/types.gen';
import { clockText } from '../base/time';

/** Time between two looks at the playlist, milliseconds. */
const LOOK_MS = 2_000;
/** Time between two changes of a countdown, milliseconds. */
const TICK_MS = 1_000;

/** An answer with a revision lower by less than this is ignored as old; with a lower one, the server has restarted. */
const BEHIND_MAX = 1_000;

/** The playlist of the server, and when this screen asked for it. */
export interface SeenPlaylist {
  state: PlaylistState;
  /** Milliseconds of this screen's clock. */
  seen_ms: number;
}

/** The playlist, asked for every `LOOK_MS`; null: not known yet. The function takes a newer answer of the server. */
export function usePlaylist(): [SeenPlaylist | null, (state: PlaylistState) => void] {
  const [seen, setSeen] = useState<SeenPlaylist | null>(null);
  const take = useCallback((state: PlaylistState) => {
    const seen_ms = Date.now();
    // A request that was under way during a change brings the playlist as it was before the change. A server that was
    // started again counts from another number.
    setSeen((before) => {
      const behind = (before?.state.revision ?? 0) - state.revision;
      return behind > 0 && behind < BEHIND_MAX ? before : { state, seen_ms };
    });
  }, []);
  useEffect(() => {
    let isOver = false;
    const look = () =>
      getPlaylist().then(
        (state) => {
          if (!isOver) take(state);
        },
        // Without a connection the last playlist stays; a banner says that the server is away.
        () => undefined,
      );
    void look();
    const timer = setInterval(() => void look(), LOOK_MS);
    return () => {
      isOver = true;
      clearInterval(timer);
    };
  }, [take]);
  return [seen, take];
}

/** Seconds until the next start, at least 0, counted down between two answers of the server; null: none. */
export function useCountdown(seen: SeenPlaylist | null): number | null {
  const [now_ms, setNow] = useState(Date.now);
  useEffect(() => {
    const timer = setInterval(() => setNow(Date.now()), TICK_MS);
    return () => clearInterval(timer);
  }, []);
  if (!seen?.state.next) return null;
  const passed_s = Math.max(0, (now_ms - seen.seen_ms) / 1000);
  return Math.max(0, seen.state.next.in_s - passed_s);
}

export const DAYS: readonly { value: PlaylistDay; label: string; title: string }[] = [
  { value: 'mon', label: 'Mo', title: 'Monday' },
  { value: 'tue', label: 'Tu', title: 'Tuesday' },
  { value: 'wed', label: 'We', title: 'Wednesday' },
  { value: 'thu', label: 'Th', title: 'Thursday' },
  { value: 'fri', label: 'Fr', title: 'Friday' },
  { value: 'sat', label: 'Sa', title: 'Saturday' },
  { value: 'sun', label: 'Su', title: 'Sunday' },
];

/** When an entry starts, in words. */
export function startText({ at, weekdays, pause_min, home }: PlaylistEntry): string {
  if (at) {
    if (!weekdays?.length) return `${at} every day`;
    const days = DAYS.filter(({ value }) => weekdays.includes(value)).map(({ label }) => label);
    return `${at} ${days.join(' ')}`;
  }
  const pause = pause_min ?? 0;
  if (home) return `Home, then ${pause} min after the show before`;
  return pause === 0 ? 'Right after the show before' : `${pause} min after the show before`;
}

const RESULTS: Record<PlaylistToday['result'], string> = {
  not_today: 'Not today',
  waiting: 'To come',
  past: 'Over before the switch',
  playing: 'Playing',
  played: 'Played',
  failed: 'Failed',
  skipped: 'Skipped',
};

/** What became of an entry today, in words. */
export function resultText({ result, time }: PlaylistToday): string {
  if (time === null) return RESULTS[result];
  if (result === 'waiting') return `Starts ${time}`;
  if (result === 'playing') return `Playing since ${time}`;
  return `${RESULTS[result]} ${time}`;
}

/** What plays now, else what starts next and in how long; `left_s`: seconds until then. */
export function nextText({ state }: SeenPlaylist, left_s: number | null): string {
  const playing = state.today.findIndex(({ result }) => result === 'playing');
  if (playing >= 0) return `${state.entries[playing]?.show ?? 'A show'} plays now.`;
  if (state.next === null) return 'Nothing is to come.';
  const { show, time } = state.next;
  if (left_s !== null && left_s < 1) return `${show} starts now.`;
  return `Next: ${show} at ${time}, in ${longText(left_s ?? 0)}.`;
}

/** A duration of `seconds`, such as `0:42`, `12:34`, `3 h 20 min` or `2 days`. */
function longText(seconds: number): string {
  if (seconds < 3_600) return clockText(seconds);
  const minutes = Math.round(seconds / 60);
  if (minutes >= 48 * 60) return `${Math.round(minutes / 1440)} days`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** The question before shows start by themselves. */
export function switchQuestion({ next }: PlaylistState, robots: string): string {
  if (next === null) return `${robots} start by themselves once an entry has its time.`;
  const when = next.in_s === 0 ? 'at once' : `at ${next.time}`;
  return `${robots} start by themselves ${when}: ${next.show}. Then all that follows in the list, every day, until you switch it off.`;
}

/** The entries with one moved up (-1) or down (1); the same ones where it cannot be moved. */
export function moved(entries: readonly PlaylistEntry[], from: number, by: -1 | 1) {
  const to = from + by;
  const entry = entries[from];
  if (!entry || to < 0 || to >= entries.length) return entries;
  return entries.toSpliced(from, 1).toSpliced(to, 0, entry);
}
