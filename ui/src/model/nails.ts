import { SAME_S, SEEN_S, withAirTimes } from './arrangeToMusic';
import type { Show } from './show';
import type { Segment } from './timeline';

/** A frame that begins less than this from its time is in time, seconds. The planner reports larger differences. */
export const IN_TIME_S = 0.05;

/** When the picture of a frame begins by plan, seconds after the first picture begins; null: there is no such frame. */
export function beginOf(timeline: readonly Segment[], index: number): number | null {
  const [first, one] = [timeline[0], timeline[index]];
  return first && one ? one.shownFrom_s - first.shownFrom_s : null;
}

/**
 * The show with air times with which nailed pictures (with `at_s`) begin in time. A picture that would begin too early
 * lengthens the air time before it. One that would begin too late shortens those before it, back to the last nailed
 * one, but none below `SEEN_S`. What they cannot give stays missing.
 */
export function fitNails(show: Show, timeline: readonly Segment[]): Show {
  const air_s = show.frames.map((frame) => frame.airTime_s);
  const drive_s = timeline.map((one) => one.shownFrom_s - one.driveFrom_s);
  let begins_s = 0;
  let free = 0;
  show.frames.forEach((frame, index) => {
    if (index > 0) begins_s += (air_s[index - 1] ?? 0) + (drive_s[index] ?? 0);
    if (frame.at_s === null || index === 0) return;
    let gap_s = frame.at_s - begins_s;
    for (let i = index - 1; i >= free && gap_s !== 0; i--) {
      const now_s = air_s[i] ?? 0;
      const least_s = Math.min(SEEN_S, now_s);
      const next_s = Math.max(least_s, now_s + gap_s);
      air_s[i] = next_s;
      gap_s -= next_s - now_s;
      begins_s += next_s - now_s;
    }
    free = index;
  });
  const all = show.frames.map((before, frame) => {
    const after_s = Math.round((air_s[frame] ?? 0) * 1000) / 1000;
    return { frame, after_s, isChange: Math.abs(after_s - before.airTime_s) >= SAME_S };
  });
  return withAirTimes(
    show,
    all.filter(({ isChange }) => isChange),
  );
}
