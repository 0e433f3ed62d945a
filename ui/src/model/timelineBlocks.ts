import type { Plan } from '../api/types.gen';
import { setFrames } from './commands';
import { goOf } from './cues';
import type { Frame, Show } from './show';
import { segmentsOf } from './timeline';

/** The planned drive to a frame. */
export interface PlannedDrive {
  duration_s: number;
  /** Shortest duration that the robots' limits allow, seconds. */
  least_s: number;
  /** The travel time that the frame asked for when the plan was seen; null: as fast as is safe. */
  asked_s: number | null;
}

/** Planned drives by the key of the frame that they lead to. */
export type PlannedDrives = ReadonlyMap<number, PlannedDrive>;

/** The drives of a plan; `show` is the show that it was made for. Empty without a plan. */
export function plannedDrives(show: Show, plan: Plan | null): PlannedDrives {
  const drives = new Map<number, PlannedDrive>();
  for (const { to, duration_s, least_s } of plan?.transitions ?? []) {
    const frame = show.frames[to];
    if (frame) drives.set(frame.key, { duration_s, least_s, asked_s: frame.transition_s });
  }
  return drives;
}

/** A frame on the timeline. Moments are in seconds of show time, which begins with the first frame's air time. */
export interface Block {
  key: number;
  frame: Frame;
  driveFrom_s: number;
  shownFrom_s: number;
  until_s: number;
  /** Shortest travel time, seconds; null: the drive is not planned. */
  least_s: number | null;
  /** What the show does after the frame until GO; null: it goes on by itself. */
  go: 'waits' | 'repeats' | null;
}

/**
 * Travel time to a frame, seconds; 0 without a plan. A travel time that the frame has asked for since the plan was made
 * counts at once, but not below the shortest one.
 */
function driveOf({ transition_s }: Frame, planned: PlannedDrive | undefined): number {
  if (!planned) return 0;
  const asked_s = transition_s ?? 0;
  // A plan that is shorter than the frame asks for is an earlier one.
  const isPlanned = transition_s === planned.asked_s && planned.duration_s >= asked_s;
  return isPlanned ? planned.duration_s : Math.max(planned.least_s, asked_s);
}

/** The frames of a show on its timeline. */
export function blocksOf(show: Show, drives: PlannedDrives): Block[] {
  const segments = segmentsOf(show, (frame) => driveOf(frame, drives.get(frame.key)));
  const start_s = segments[0]?.shownFrom_s ?? 0;
  return show.frames.flatMap((frame, index) => {
    const segment = segments[index];
    if (!segment) return [];
    return {
      key: frame.key,
      frame,
      driveFrom_s: segment.driveFrom_s - start_s,
      shownFrom_s: segment.shownFrom_s - start_s,
      until_s: segment.until_s - start_s,
      least_s: drives.get(frame.key)?.least_s ?? null,
      go: goOf(show, index),
    };
  });
}

/** From the start of the first drive to the start of show time, seconds. */
export const leadIn_s = (blocks: readonly Block[]) => -(blocks[0]?.driveFrom_s ?? 0);

/**
 * The show time on the stage, seconds. `preview_s`: the moment of the preview, seconds from the start of the first
 * drive; null: there is no preview, and the start of frame `frame`'s air time counts.
 */
export const momentOnStage = (blocks: readonly Block[], frame: number, preview_s: number | null) =>
  preview_s === null ? (blocks[frame]?.shownFrom_s ?? 0) : preview_s - leadIn_s(blocks);

/** An edge of a block: the end of its travel time, or of its air time. */
export type BlockEdge = 'travel' | 'air';

/** Longest travel time and air time, seconds. */
const LONGEST_S = 3600;
/** A travel time this close to the shortest one is the shortest one, seconds. */
const SAME_S = 0.005;

const hundredths = (seconds: number) => Math.round(seconds * 100) / 100;

/** The show with another travel time of a frame. At or below the shortest one, the frame asks for the fastest drive. */
function withTravel(show: Show, index: number, block: Block | undefined, travel_s: number): Show {
  if (!block || block.least_s === null) return show;
  const isLeast = travel_s <= block.least_s + SAME_S;
  const transition_s = isLeast ? null : Math.min(LONGEST_S, hundredths(travel_s));
  return setFrames(show, [index], { transition_s });
}

const withAir = (show: Show, index: number, air_s: number): Show =>
  setFrames(show, [index], { airTime_s: Math.max(0, Math.min(LONGEST_S, hundredths(air_s))) });

/** Gives all these frames `by_s` seconds more travel time or air time, within limits; `blocks` are those of `show`. */
export function stretchBlocks(
  show: Show,
  blocks: readonly Block[],
  indices: readonly number[],
  edge: BlockEdge,
  by_s: number,
): Show {
  return indices.reduce((now, index) => {
    const block = blocks[index];
    if (!block) return now;
    if (edge === 'air') return withAir(now, index, block.frame.airTime_s + by_s);
    const travel_s = block.shownFrom_s - block.driveFrom_s + by_s;
    // A drag that came back to where it began leaves the way of getting there as it was.
    return Math.abs(by_s) < SAME_S ? now : withTravel(now, index, block, travel_s);
  }, show);
}

/**
 * The show in which an edge of block `dragged` is at `to_s`, as far as limits allow. If the block is chosen, all
 * chosen frames change by the same time. The changes up to the dragged one add up to the shift of the edge.
 */
export function dragBlockEdge(
  show: Show,
  blocks: readonly Block[],
  chosen: readonly number[],
  dragged: number,
  edge: BlockEdge,
  to_s: number,
): Show {
  const block = blocks[dragged];
  if (!block) return show;
  const indices = chosen.includes(dragged) ? chosen : [dragged];
  const share = indices.filter((index) => index <= dragged).length;
  const from_s = edge === 'air' ? block.until_s : block.shownFrom_s;
  return stretchBlocks(show, blocks, indices, edge, (to_s - from_s) / share);
}

/** Whether the travel time of a block is the shortest that the plan allows. */
export const isFastest = ({ driveFrom_s, shownFrom_s, least_s }: Block) =>
  least_s !== null && shownFrom_s - driveFrom_s <= least_s + SAME_S;

/** Indices of the blocks that overlap the time between two moments, in either order. */
export const blocksBetween = (blocks: readonly Block[], a_s: number, b_s: number): number[] => {
  const [from_s, to_s] = [Math.min(a_s, b_s), Math.max(a_s, b_s)];
  return blocks.flatMap((b, i) => (b.driveFrom_s < to_s && b.until_s > from_s ? [i] : []));
};
