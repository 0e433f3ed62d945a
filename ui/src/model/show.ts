import type { Obstacle } from '../base/geometry';
import type { Rgb } from '../base/colour';
import type { Motion } from './motion';
import type { FrameSource, SourcePart } from './sources';

/** A show: frames in playing order, and the stage they play on. Values are never changed in place. */
export interface Show {
  name: string;
  stage: Stage;
  identity: Identity;
  music: string | null;
  frames: readonly Frame[];
  /** The other fields of the document as JSON, such as layers and assets. Unknown ones are saved as they were read. */
  rest: Readonly<Record<string, unknown>>;
}

export interface Stage {
  /** Extent along x, metres. */
  width_m: number;
  /** Extent along y, metres. */
  depth_m: number;
  obstacles: readonly Obstacle[];
  /** Radius of a robot, metres. */
  radius_m: number;
  rest: Readonly<Record<string, unknown>>;
}

/** Whether any robot may show any pixel, or pixel n is the same robot in every frame. */
export type Identity = 'any' | 'fixed';
export type Easing = 'swift' | 'gentle';

/** A picture: one pixel per robot, its air time, and the drive to it. */
export interface Frame {
  /** Identifies the frame on this screen; not saved. */
  key: number;
  /** Word by which layers, cues and trajectories name the frame; null: nothing names it. */
  id: string | null;
  name: string;
  /** How long the picture stays, seconds. */
  airTime_s: number;
  /** Show time at which the picture must begin, seconds; null: as soon as the robots are there. */
  at_s: number | null;
  /** Wanted travel time to the frame, seconds; null: as fast as is safe. */
  transition_s: number | null;
  easing: Easing;
  /** How the picture before drives to the frame; null: the planner's shortest drive. */
  motion: Motion | null;
  /** Overrides the show's assignment; null: the show's. */
  identity: Identity | null;
  /** What the pixels were made from; empty: drawn by hand. */
  sources: readonly FrameSource[];
  /** Sorted by id, ids unique. */
  pixels: readonly Pixel[];
  rest: Readonly<Record<string, unknown>>;
}

export interface Pixel {
  id: number;
  /** Stage metres. */
  x: number;
  y: number;
  color: Rgb;
  /** The robot that is pinned to the pixel; null: any robot. */
  robot: string | null;
  /** The part of a source that the pixel belongs to; null: drawn by hand. */
  part: SourcePart | null;
  /** A word that pixels of the frame share which are edited as one; null: the pixel is in no group. */
  group: string | null;
}

let lastKey = 0;
/** A key that no frame of this page has had. */
export const newKey = () => ++lastKey;

/** Distance of centres at which two robots touch, metres. */
export const contact_m = (stage: Stage) => 2 * stage.radius_m;

/** Least distance of pixels that the planner handles well, metres. */
export const tooClose_m = (stage: Stage) => 2 * stage.radius_m + 0.006;

export const EMPTY_STAGE: Stage = {
  width_m: 3,
  depth_m: 3,
  obstacles: [],
  radius_m: 0.027,
  rest: {},
};

/** `count` pixels, ids from 0, in rows 0.1 m apart. The first row is 0.2 m from the edge with the largest y. */
export function backRows(stage: Stage, count: number, color: Rgb): Pixel[] {
  const [step, margin] = [0.1, 0.05];
  const perRow = Math.max(1, Math.floor((stage.width_m - 2 * margin) / step + 1e-9) + 1);
  return Array.from({ length: count }, (_, id) => ({
    id,
    x: -stage.width_m / 2 + margin + (id % perRow) * step,
    y: stage.depth_m / 2 - 0.2 - Math.floor(id / perRow) * step,
    color,
    robot: null,
    part: null,
    group: null,
  }));
}

export function newFrame(name: string, pixels: readonly Pixel[]): Frame {
  return {
    key: newKey(),
    id: null,
    name,
    airTime_s: 1,
    at_s: null,
    transition_s: null,
    easing: 'swift',
    motion: null,
    identity: null,
    sources: [],
    pixels,
    rest: {},
  };
}

/** The frame that represents a show: the middle one, because many shows begin and end in rows. */
export const middleFrame = ({ frames }: Show): Frame | undefined =>
  frames[Math.floor(frames.length / 2)];

/** A new show: one frame with `count` pixels at `backRows`, warm white. */
export function newShow(name: string, count: number, stage: Stage = EMPTY_STAGE): Show {
  const frames = [newFrame('Start', backRows(stage, count, 0xffc878))];
  return { name, stage, identity: 'any', music: null, frames, rest: {} };
}
