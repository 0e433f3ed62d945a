import type { Dot } from '../base/geometry';
import type { Plan } from '../api/types.gen';
import { mix } from '../base/colour';
import { pathAt } from './path';
import type { Frame, Show } from './show';

/** Times of the drive to a frame and of its picture, seconds from the start of the show. */
export interface Segment {
  frame: number;
  driveFrom_s: number;
  shownFrom_s: number;
  until_s: number;
}

/** The times of a show with the drives of a plan; a drive without a plan takes no time. */
export const timelineOf = (show: Show, plan: Plan | null): Segment[] =>
  segmentsOf(show, (_, index) => plan?.transitions[index]?.duration_s ?? 0);

/** The times of a show in which the drive to each frame takes `drive_s` seconds. */
export function segmentsOf(
  show: Show,
  drive_s: (frame: Frame, index: number) => number,
): Segment[] {
  let clock = 0;
  return show.frames.map((frame, index) => {
    const driveFrom_s = clock;
    const shownFrom_s = driveFrom_s + drive_s(frame, index);
    clock = shownFrom_s + Math.max(0, frame.airTime_s);
    return { frame: index, driveFrom_s, shownFrom_s, until_s: clock };
  });
}

export const totalOf = (timeline: readonly Segment[]) =>
  timeline[timeline.length - 1]?.until_s ?? 0;

/** The segment at a moment; the last one at and after the end, the first one before the start; null: none. */
export function segmentAt(timeline: readonly Segment[], time_s: number): Segment | null {
  return timeline.find((s) => time_s < s.until_s) ?? timeline[timeline.length - 1] ?? null;
}

/**
 * The moment that a preview begins with, seconds from the start of the show: `time_s`, the moment on the stage. Without
 * one, or at its end: when frame `frame` is reached, but 0 for the first and the last frame.
 */
export function previewFrom(
  timeline: readonly Segment[],
  frame: number,
  time_s: number | null,
): number {
  if (time_s !== null && time_s < totalOf(timeline)) return time_s;
  // The first frame is shown with the drive that leads to it; after the last frame nothing is left to show.
  const isEdge = frame === 0 || frame === timeline.length - 1;
  return isEdge ? 0 : (timeline[frame]?.shownFrom_s ?? 0);
}

/** Planned positions, stage metres, and colours at a moment; without paths the pixels of the frame at that moment. */
export function dotsAt(
  show: Show,
  plan: Plan,
  timeline: readonly Segment[],
  time_s: number,
): Dot[] {
  const segment = segmentAt(timeline, time_s);
  const to = segment && show.frames[segment.frame];
  if (!segment || !to) return [];
  const transition = plan.transitions[segment.frame];
  if (!transition || transition.paths.length === 0)
    return to.pixels.map((p) => ({ x: p.x, y: p.y, color: p.color, alpha: 1 }));
  const before = plan.transitions[segment.frame - 1]?.pixels ?? [];
  const [was, is] = [colours(show, segment.frame - 1), colours(show, segment.frame)];
  const span = Math.max(1e-6, segment.shownFrom_s - segment.driveFrom_s);
  const t = Math.max(0, time_s - segment.driveFrom_s);
  return transition.paths.map((path, robot) => {
    const end = is.get(transition.pixels[robot] ?? -1) ?? 0;
    const start = was.get(before[robot] ?? -1) ?? end;
    return { ...pathAt(path, t), color: mix(start, end, Math.min(1, t / span)), alpha: 1 };
  });
}

const colours = (show: Show, frame: number) =>
  new Map(show.frames[frame]?.pixels.map((p) => [p.id, p.color]));
