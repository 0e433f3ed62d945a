import type { Plan, Transition } from '../api/types.gen';
import type { Point, Polyline } from '../base/geometry';
import { polyline } from './path';
import type { Pixel, Show } from './show';

let drawn: { transition?: Transition; pixels?: readonly Pixel[]; paths: readonly Polyline[] } = {
  paths: [],
};

/**
 * The planned paths to frame `to`, counted from 0, in the colours of its pixels; black without a pixel. The same list
 * as in the last call while transition and pixels are the same.
 */
export function pathsTo(plan: Plan | null, show: Show | null, to: number): readonly Polyline[] {
  const transition = plan?.transitions.find((t) => t.to === to);
  const pixels = show?.frames[to]?.pixels;
  if (drawn.transition !== transition || drawn.pixels !== pixels)
    drawn = { transition, pixels, paths: transition ? polylinesOf(transition, pixels ?? []) : [] };
  return drawn.paths;
}

const lines = new WeakMap<Transition, readonly (readonly Point[])[]>();

function pointsOf(transition: Transition) {
  const known = lines.get(transition) ?? transition.paths.map(polyline);
  lines.set(transition, known);
  return known;
}

function polylinesOf(transition: Transition, pixels: readonly Pixel[]): readonly Polyline[] {
  const colors = new Map(pixels.map((p) => [p.id, p.color]));
  return pointsOf(transition).map((points, robot) => ({
    points,
    color: colors.get(transition.pixels[robot] ?? -1) ?? 0,
  }));
}
