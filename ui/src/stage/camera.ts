import type { Point } from '../base/geometry';

/** Maps the stage to the canvas, seen from above. Stage: metres, y up; canvas: CSS pixels, y down. */
export interface Camera {
  /** CSS pixels per metre. */
  scale: number;
  /** CSS pixel of the stage's origin. */
  originX_px: number;
  originY_px: number;
}

export interface Size {
  width_px: number;
  height_px: number;
}

/** Smallest zoom, CSS pixels per metre. */
const SCALE_MIN = 10;
/** Largest zoom, CSS pixels per metre. */
const SCALE_MAX = 6000;

/**
 * The camera that centres the floor with a margin on all sides and `top_px` more above it, CSS pixels. The whole floor
 * is in view unless that needs a zoom below `SCALE_MIN`.
 */
export function fit(
  width_m: number,
  depth_m: number,
  size: Size,
  margin_px: number,
  top_px = 0,
): Camera {
  const scale = Math.min(
    (size.width_px - 2 * margin_px) / Math.max(width_m, 0.1),
    (size.height_px - 2 * margin_px - top_px) / Math.max(depth_m, 0.1),
  );
  return {
    scale: Math.max(SCALE_MIN, Math.min(SCALE_MAX, scale)),
    originX_px: size.width_px / 2,
    originY_px: (size.height_px + top_px) / 2,
  };
}

export const canvasFromStage = (c: Camera, p: Point): Point => ({
  x: c.originX_px + p.x * c.scale,
  y: c.originY_px - p.y * c.scale,
});

export const stageFromCanvas = (c: Camera, p: Point): Point => ({
  x: (p.x - c.originX_px) / c.scale,
  y: (c.originY_px - p.y) / c.scale,
});

/** Zooms by `factor`, within the limits of the zoom, and keeps what is under `at` (CSS pixels) where it is. */
export function zoomAt(c: Camera, at: Point, factor: number): Camera {
  const scale = Math.max(SCALE_MIN, Math.min(SCALE_MAX, c.scale * factor));
  const k = scale / c.scale;
  return {
    scale,
    originX_px: at.x - (at.x - c.originX_px) * k,
    originY_px: at.y - (at.y - c.originY_px) * k,
  };
}

export const panBy = (c: Camera, dx_px: number, dy_px: number): Camera => ({
  ...c,
  originX_px: c.originX_px + dx_px,
  originY_px: c.originY_px + dy_px,
});

/** The least step of 1, 2 or 5 times a power of ten that is `least_px` wide at `scale` pixels a unit. */
export function gridStep(scale: number, least_px = 60): number {
  const least_m = least_px / scale;
  const power = 10 ** Math.floor(Math.log10(least_m));
  for (const k of [1, 2, 5, 10]) if (k * power >= least_m * 0.999) return k * power;
  return 10 * power;
}
