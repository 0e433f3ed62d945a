import type { MakeShape } from '../api/types.gen';
import { boxOf, centreOf, scaleAbout, type Point } from '../base/geometry';
import type { Draft } from './draft';
import { drawnKind } from './drawnLine';
import {
  cornerAt,
  onFloor,
  pictureFromStage,
  SIZE_MIN_M,
  stageFromPicture,
  type Floor,
  type Picture,
} from './picture';
import { ASPECT, SHAPE_NUMBERS } from './shapeNumbers';

/** A side of a picture, by its direction from the middle along the picture's axes: ±1 along one, 0 along the other. */
export type Side = { sx: -1 | 1; sy: 0 } | { sx: 0; sy: -1 | 1 };

export const SIDES: readonly Side[] = [
  { sx: 0, sy: 1 },
  { sx: 1, sy: 0 },
  { sx: 0, sy: -1 },
  { sx: -1, sy: 0 },
];

/** What changes when a picture is stretched: its ratio of width to height, which is `aspect` now, or its points. */
export type Stretch = { by: 'aspect'; aspect: number } | { by: 'points' };

/** Whether the picture of a draft can be stretched: drawn lines, but not straight ones, and shapes with an aspect. */
export function isStretchable(draft: Draft): boolean {
  const drawn = drawnKind(draft);
  if (drawn !== null) return drawn !== 'line';
  return draft.tab === 'shape' && SHAPE_NUMBERS[draft.shape]?.includes('aspect') === true;
}

/** How a draft's picture is stretched; null: it cannot be, or its aspect is not known. `shapes`: usual settings. */
export function stretchOf(draft: Draft, shapes: readonly MakeShape[]): Stretch | null {
  if (!isStretchable(draft)) return null;
  if (drawnKind(draft) !== null) return { by: 'points' };
  const usual = shapes.find((shape) => shape.name === draft.shape)?.aspect;
  const aspect = draft.shapeNumbers.aspect ?? usual;
  return typeof aspect === 'number' ? { by: 'aspect', aspect } : null;
}

/** What is stretched: the picture, and the settings that it is made from. */
export interface Stretched {
  picture: Picture;
  draft: Draft;
  stretch: Stretch;
}

/**
 * The settings after a side was dragged from one place to another, stage metres. The opposite side stays, or with
 * `about` the middle. Size and aspect stay within their limits.
 */
export function stretchedBy(
  { picture, draft, stretch }: Stretched,
  side: Side,
  drag: readonly [Point, Point],
  about: boolean,
  floor: Floor,
): Partial<Draft> {
  const [low, high] = [cornerAt(picture, { sx: -1, sy: -1 }), cornerAt(picture, { sx: 1, sy: 1 })];
  const axis = side.sx === 0 ? 'y' : 'x';
  const isForward = side.sx + side.sy > 0;
  const still = about ? 0 : (isForward ? low : high)[axis];
  const [from, to] = drag.map((p) => pictureFromStage(picture, p)[axis]) as [number, number];
  const lengths = { x: high.x - low.x, y: high.y - low.y };
  const most_m = axis === 'x' ? floor.width_m : floor.depth_m;
  const wanted = from === still ? 1 : (to - still) / (from - still);
  const least = Math.max(SIZE_MIN_M / lengths[axis], leastFactor(stretch, axis));
  const k = Math.max(least, Math.min(wanted, most_m / lengths[axis], mostFactor(stretch, axis)));
  const after = { ...lengths, [axis]: lengths[axis] * k };
  const size_m = (picture.size_m * Math.max(after.x, after.y)) / Math.max(lengths.x, lengths.y);
  const center = stageFromPicture(picture, { x: 0, y: 0, [axis]: still * (1 - k) });
  const [kx, ky] = axis === 'x' ? [k, 1] : [1, k];
  return {
    size_m: tidy(size_m),
    center: onFloor(center, floor),
    ...(stretch.by === 'aspect'
      ? { shapeNumbers: { ...draft.shapeNumbers, aspect: tidy((stretch.aspect * kx) / ky) } }
      : { points: scaled(draft.points, kx, ky) }),
  };
}

/** Least factor by which the picture may be stretched along an axis, so that its aspect stays within `ASPECT`. */
const leastFactor = (stretch: Stretch, axis: 'x' | 'y') =>
  stretch.by === 'points'
    ? 0
    : axis === 'x'
      ? ASPECT.min / stretch.aspect
      : stretch.aspect / ASPECT.max;

const mostFactor = (stretch: Stretch, axis: 'x' | 'y') =>
  stretch.by === 'points'
    ? Infinity
    : axis === 'x'
      ? ASPECT.max / stretch.aspect
      : stretch.aspect / ASPECT.min;

function scaled(points: readonly Point[], kx: number, ky: number): Point[] {
  const middle = centreOf(boxOf(points));
  return points.map((p) => scaleAbout(p, middle, kx, ky));
}

/** Rounded to four digits after the point. */
const tidy = (value: number) => Math.round(value * 1e4) / 1e4;
