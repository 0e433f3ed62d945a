import type { Rgb } from './colour';

export interface Point {
  x: number;
  y: number;
}

/** A coloured disc of light on the floor, stage metres. */
export interface Dot extends Point {
  color: Rgb;
  /** Opacity, 0 to 1. */
  alpha: number;
}

/** A coloured line through points, stage metres. */
export interface Polyline {
  points: readonly Point[];
  color: Rgb;
}

/** An area of the floor that robots must not touch, stage metres. */
export type Obstacle =
  | { kind: 'disc'; x: number; y: number; radius_m: number }
  | { kind: 'rect'; minX: number; minY: number; maxX: number; maxY: number };

export interface Box {
  minX: number;
  minY: number;
  maxX: number;
  maxY: number;
}

/** The bounding box of points; without points a box of size 0 at the origin. */
export function boxOf(points: readonly Point[]): Box {
  if (points.length === 0) return { minX: 0, minY: 0, maxX: 0, maxY: 0 };
  const box = { minX: Infinity, minY: Infinity, maxX: -Infinity, maxY: -Infinity };
  for (const p of points) {
    box.minX = Math.min(box.minX, p.x);
    box.minY = Math.min(box.minY, p.y);
    box.maxX = Math.max(box.maxX, p.x);
    box.maxY = Math.max(box.maxY, p.y);
  }
  return box;
}

export const centreOf = (box: Box): Point => ({
  x: (box.minX + box.maxX) / 2,
  y: (box.minY + box.maxY) / 2,
});

export const boxBetween = (a: Point, b: Point): Box => boxOf([a, b]);

export const inBox = (p: Point, box: Box) =>
  p.x >= box.minX && p.x <= box.maxX && p.y >= box.minY && p.y <= box.maxY;

/** Whether a point lies in a polygon, by the even-odd rule; its last corner is joined to the first. */
export function inPolygon(p: Point, polygon: readonly Point[]): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [a, b] = [polygon[i] as Point, polygon[j] as Point];
    if (a.y > p.y !== b.y > p.y && p.x < ((b.x - a.x) * (p.y - a.y)) / (b.y - a.y) + a.x)
      inside = !inside;
  }
  return inside;
}

export const rotate = (p: Point, about: Point, angle: number): Point => {
  const [dx, dy, c, s] = [p.x - about.x, p.y - about.y, Math.cos(angle), Math.sin(angle)];
  return { x: about.x + dx * c - dy * s, y: about.y + dx * s + dy * c };
};

export const scaleAbout = (p: Point, about: Point, kx: number, ky: number): Point => ({
  x: about.x + (p.x - about.x) * kx,
  y: about.y + (p.y - about.y) * ky,
});
