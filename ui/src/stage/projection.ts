import type { Point } from '../base/geometry';
import { fit, type Size } from './camera';

/** From where the audience sees the floor: from above, or in perspective from before the edge with the least y. */
export type Viewpoint = 'above' | 'front';

/** Where a place of the stage is in the window, CSS pixels from its upper left corner. */
export interface Seen {
  x_px: number;
  y_px: number;
  /** CSS pixels a metre at that place; 0: the place is behind the viewer. */
  scale: number;
  /** Height of a circle on the floor, as a share of its width. */
  flatness: number;
}

/** Writes where a place of the stage is on the screen into `seen`. */
export type Projection = (place: Point, seen: Seen) => void;

/** Extent of the floor, metres. */
export interface FloorSize {
  width_m: number;
  depth_m: number;
}

/** Room on each side of the floor, as a share of the window's shorter side: lights at the edge keep their glow. */
const MARGIN = 0.035;
/** Distance of the viewer from the front edge, as a share of the longer side of the floor. */
const BACK = 0.62;
/** Height of the viewer above the floor, as a share of the longer side of the floor. */
const RISE = 0.52;
/** Least distance along the view of a place that is drawn, metres: nearer ones would grow without bound. */
const NEAR_M = 0.1;
/** Least size of the picture along an axis, CSS pixels: a window that is being opened has size 0. */
const LEAST_PX = 8;

export const newSeen = (): Seen => ({ x_px: 0, y_px: 0, scale: 0, flatness: 1 });

/** The whole floor as seen from a viewpoint, fitted into a window of `size`. */
export const projectionOf = (viewpoint: Viewpoint, floor: FloorSize, size: Size): Projection =>
  viewpoint === 'above' ? fromAbove(floor, size) : fromFront(floor, size);

const marginOf = (size: Size) => MARGIN * Math.min(size.width_px, size.height_px);

function fromAbove({ width_m, depth_m }: FloorSize, size: Size): Projection {
  const { scale, originX_px, originY_px } = fit(width_m, depth_m, size, marginOf(size));
  return (place, seen) => {
    seen.x_px = originX_px + place.x * scale;
    seen.y_px = originY_px - place.y * scale;
    seen.scale = scale;
    seen.flatness = 1;
  };
}

/** A pinhole camera before the front edge, turned to the middle of the floor; the floor fits the window by one axis. */
function fromFront({ width_m, depth_m }: FloorSize, size: Size): Projection {
  const side_m = Math.max(width_m, depth_m, 0.1);
  const rise_m = RISE * side_m;
  const viewer_m = -depth_m / 2 - BACK * side_m;
  const pitch = Math.atan2(rise_m, -viewer_m);
  const [cos, sin] = [Math.cos(pitch), Math.sin(pitch)];
  const look = (x: number, y: number) => {
    const along_m = y - viewer_m;
    const away_m = along_m * cos + rise_m * sin;
    return { x: x / away_m, y: (rise_m * cos - along_m * sin) / away_m, along_m, away_m };
  };
  const near = look(width_m / 2, -depth_m / 2);
  const far = look(width_m / 2, depth_m / 2);
  const half = Math.max(near.x, far.x);
  const margin = 2 * marginOf(size);
  const focus_px = Math.min(
    Math.max(LEAST_PX, size.width_px - margin) / (2 * half),
    Math.max(LEAST_PX, size.height_px - margin) / (near.y - far.y),
  );
  const originX_px = size.width_px / 2;
  const originY_px = size.height_px / 2 - (focus_px * (near.y + far.y)) / 2;
  return (place, seen) => {
    const at = look(place.x, place.y);
    seen.x_px = originX_px + focus_px * at.x;
    seen.y_px = originY_px + focus_px * at.y;
    seen.scale = at.away_m < NEAR_M ? 0 : focus_px / at.away_m;
    seen.flatness = rise_m / Math.hypot(rise_m, at.along_m);
  };
}
