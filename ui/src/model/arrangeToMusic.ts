import { beatsBetween, type Beats } from './beats';
import { setFrames } from './commands';
import type { Show } from './show';
import type { Segment } from './timeline';

/** A frame whose air time changes so that the next picture begins with a bar. */
export interface NewAirTime {
  /** Index of the frame. */
  frame: number;
  before_s: number;
  after_s: number;
  /** What begins with the bar: index of the next frame; null: the end of the show. */
  next: number | null;
  /** The bar, counted from 1. */
  bar: number;
}

/** Least new air time, seconds: a shorter picture is missed. A frame that is shorter already may keep its air time. */
export const SEEN_S = 0.5;

/** Changes of an air time below this are left out, seconds. */
export const SAME_S = 0.001;

/**
 * Air times with which each picture after the first begins with a bar of the music, and the show ends with one. Each
 * goes to the bar nearest to its present moment that leaves time for the drive. Drives keep their durations. Frames
 * without a change, or without such a bar, are left out.
 */
export function arrangeToMusic(
  show: Show,
  timeline: readonly Segment[],
  beats: Beats,
): NewAirTime[] {
  const start_s = timeline[0]?.shownFrom_s ?? 0;
  const end_s = (timeline[timeline.length - 1]?.until_s ?? 0) - start_s;
  const bars = beatsBetween(beats, 0, end_s + 60).filter(({ isBar }) => isBar);
  const found: NewAirTime[] = [];
  let begins_s = 0;
  show.frames.forEach((frame, index) => {
    const [now, next] = [timeline[index], timeline[index + 1]];
    if (!now || bars.length === 0) return;
    const drive_s = next ? next.shownFrom_s - next.driveFrom_s : 0;
    const wanted_s = (next ? next.shownFrom_s : now.until_s) - start_s;
    const earliest_s = begins_s + Math.min(SEEN_S, frame.airTime_s) + drive_s;
    const possible = bars.filter(({ at_s }) => at_s >= earliest_s - 1e-9);
    const bar = possible.reduce<(typeof bars)[number] | null>(
      (best, one) =>
        best && Math.abs(best.at_s - wanted_s) <= Math.abs(one.at_s - wanted_s) ? best : one,
      null,
    );
    if (!bar) {
      begins_s += frame.airTime_s + drive_s;
      return;
    }
    const after_s = Math.round((bar.at_s - drive_s - begins_s) * 1000) / 1000;
    begins_s += after_s + drive_s;
    if (Math.abs(after_s - frame.airTime_s) < SAME_S) return;
    found.push({
      frame: index,
      before_s: frame.airTime_s,
      after_s,
      next: next ? index + 1 : null,
      bar: bars.indexOf(bar) + 1,
    });
  });
  return found;
}

/** The show with these air times. */
export function withAirTimes(
  show: Show,
  changes: readonly Pick<NewAirTime, 'frame' | 'after_s'>[],
): Show {
  return changes.reduce(
    (now, { frame, after_s }) => setFrames(now, [frame], { airTime_s: after_s }),
    show,
  );
}
