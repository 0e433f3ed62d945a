import type { Plan, PlanningRequest } from '../api/types.gen';
import { writeShow } from '../model/json';
import type { Frame, Show } from '../model/show';
import { secondsText } from '../base/time';
import { pixelsOf } from './frame';
import type { Maker } from './maker';
import type { Picture } from './pictures';

/** The drives to the pictures that are made, planned in the browser. */
export interface Drives {
  /** The plan; `transitions[first + n]` leads to picture `n`. */
  plan: Plan;
  first: number;
}

/**
 * Plans the drives to pictures that would take the place of a frame. Null: a newer request replaced this one, planning
 * failed, or the frame before has another number of pixels.
 */
export async function planDrives(
  maker: Maker,
  show: Show,
  frame: Frame,
  pictures: readonly Picture[],
): Promise<Drives | null> {
  const before = show.frames[show.frames.findIndex((one) => one.key === frame.key) - 1];
  const made = pictures.map((picture) => ({ ...frame, pixels: pixelsOf(picture.answer) }));
  if (before && before.pixels.length !== made[0]?.pixels.length) return null;
  const answer = await maker.plan(requestOf(show, before, made));
  return answer?.plan ? { plan: answer.plan, first: before ? 1 : 0 } : null;
}

/** The plan with only the drive to picture `nth`, given as the drive to frame `frame`, both counted from 0. */
export const planTo = ({ plan, first }: Drives, nth: number, frame: number): Plan => ({
  ...plan,
  transitions: plan.transitions
    .slice(first + nth, first + nth + 1)
    .map((t) => ({ ...t, to: frame })),
});

/** A line for people about the drives. */
export function drivesText({ plan, first }: Drives): string {
  const [least, most] = leastAndMost(plan.transitions.slice(first).map((t) => t.duration_s));
  if (!plan.ok || least === undefined || most === undefined)
    return 'No collision-free drive to this frame';
  const times =
    least === most ? secondsText(most) : `${secondsText(least)} to ${secondsText(most)}`;
  return `Collision-free drive of ${times}`;
}

function leastAndMost(numbers: readonly number[]): [number?, number?] {
  return numbers.length === 0 ? [] : [Math.min(...numbers), Math.max(...numbers)];
}

/** A request for the drives to the made frames, from the frame before them; without one, from the show's starts. */
function requestOf(show: Show, before: Frame | undefined, made: readonly Frame[]): PlanningRequest {
  const frames = [...(before ? [before] : []), ...made].map(bare);
  const rest = before
    ? { starts: before.pixels.map(({ x, y }) => [x, y]) }
    : pick(show.rest, 'starts');
  return { show: writeShow({ ...show, music: null, frames, rest }), quality: 'quick' };
}

/** A frame without id, absolute time, motion and sources, as the planner needs it. */
export const bare = (frame: Frame): Frame => ({
  ...frame,
  id: null,
  at_s: null,
  motion: null,
  sources: [],
  pixels: frame.pixels.map((pixel) => ({ ...pixel, part: null })),
});

const pick = (record: Readonly<Record<string, unknown>>, name: string) =>
  name in record ? { [name]: record[name] } : {};
