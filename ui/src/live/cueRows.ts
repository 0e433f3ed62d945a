import type { Playback, Repeats } from '../api/types.gen';
import { cueOf, loopFrom } from '../model/cues';
import type { Frame, Show } from '../model/show';

/** A frame in the list of cues. */
export interface CueRow {
  key: number;
  /** Counted from 0. */
  index: number;
  name: string;
  air_s: number;
  /** Name of the cue at the end of the frame; may be empty. Null: the show goes on by itself. */
  cue: string | null;
  /** Index of the frame from which the show repeats until GO; null: it does not repeat. */
  from: number | null;
  /** Whether the frame plays now or is next; null: neither. */
  place: 'now' | 'next' | null;
}

/** What is read of the playback. */
export type CuePlayback = Pick<Playback, 'phase' | 'frame' | 'next'>;

/** Whether a show is being played, even if it is paused or its robots are out of reach. */
export const isPlayed = (phase: Playback['phase']) =>
  phase === 'preparing' || phase === 'playing' || phase === 'paused' || phase === 'link_lost';

/** The frames in playing order. While no show is played, the chosen one is next. */
export function cueRows(show: Show, playback: CuePlayback, chosen: number): CueRow[] {
  const plays = isPlayed(playback.phase);
  const [now, next] = plays ? [playback.frame, playback.next] : [null, chosen];
  return show.frames.map((frame, index) => ({
    key: frame.key,
    index,
    name: frame.name,
    air_s: frame.airTime_s,
    cue: cueOf(show, frame),
    from: fromOf(show, index),
    place: index === now ? 'now' : index === next ? 'next' : null,
  }));
}

function fromOf(show: Show, index: number): number | null {
  const from = loopFrom(show, index);
  return from === 'lost' ? null : from;
}

/** How the show goes on after the frame of a row. */
export function wayOn({ index, cue, from }: Pick<CueRow, 'index' | 'cue' | 'from'>): string {
  if (cue === null) return 'goes on by itself';
  if (from === null) return cue ? `GO: ${cue}` : 'waits for GO';
  const what = from === index ? 'repeats until GO' : `repeats from frame ${from + 1} until GO`;
  return cue ? `${what}: ${cue}` : what;
}

/** The frames that repeat until GO, in words. */
export function repeatsText({ first, last, round, leaves }: Repeats): string {
  const frames =
    first === last ? `Frame ${first + 1} repeats` : `Frames ${first + 1} to ${last + 1} repeat`;
  if (!leaves) return `${frames} until GO (round ${round})`;
  return `GO was given: on after frame ${last + 1} (round ${round})`;
}

/** A frame by number and name, `3 Heart`, or `Frame 3` without a name; a dash where there is no frame. */
export function frameText(frames: readonly Frame[], index: number | null): string {
  const frame = index === null ? undefined : frames[index];
  if (index === null || !frame) return '–';
  return frame.name ? `${index + 1} ${frame.name}` : `Frame ${index + 1}`;
}

/** Why robots cannot be sent to a frame; null: they can. */
export function whyNoJump(
  { phase, may_jump }: Pick<Playback, 'phase' | 'may_jump'>,
  linked: boolean,
): string | null {
  if (!linked) return 'There is no connection right now.';
  if (isPlayed(phase))
    return may_jump ? null : 'Robots are driving: pause the show, or wait until they stand.';
  return phase === 'ready' ? null : 'Robots are not ready yet.';
}

/** The question before robots drive to a frame; `index` counts from 0. */
export function jumpQuestion(frames: readonly Frame[], index: number, plays: boolean): string {
  const name = frames[index]?.name;
  const frame = `frame ${index + 1}${name ? `, ${name}` : ''}`;
  return plays ? `Go to ${frame}?` : `Play from ${frame}?`;
}
