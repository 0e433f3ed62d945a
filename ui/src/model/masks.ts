import { list, number, object, text, type Json } from './jsonFields';
import type { Layer } from './layers';

/** What the screen offers as the part of the robots or of the floor on which a layer shines. */
export const MASKS = ['all', 'pixels', 'circle', 'rectangle'] as const;
export type MaskChoice = (typeof MASKS)[number];

/** The only mask of a layer, as the document has it; null: the layer has none, or several. */
export function maskOf({ settings }: Layer): Json | null {
  const masks = list(settings.masks);
  return masks.length === 1 ? object(masks[0]) : null;
}

/** Where a layer shines; `other`: several masks, or a shape that the screen does not offer. */
export function maskChoice(layer: Layer): MaskChoice | 'other' {
  if (list(layer.settings.masks).length === 0) return 'all';
  const shape = text(maskOf(layer)?.shape);
  return MASKS.find((one) => one === shape) ?? 'other';
}

/** The masks for a choice: one, or undefined for all robots. `chosen`: ids of pixels, for `pixels` alone. */
export function newMask(choice: MaskChoice, chosen: Iterable<number>): readonly Json[] | undefined {
  switch (choice) {
    case 'all':
      return undefined;
    case 'pixels':
      return [{ shape: 'pixels', pixels: [...chosen] }];
    case 'circle':
      return [{ shape: 'circle', center: [0, 0], radius_m: 0.5 }];
    case 'rectangle':
      return [{ shape: 'rectangle', center: [0, 0], size_m: [1, 1] }];
  }
}

/** Ids of the pixels of a mask; empty for another shape. */
export const maskPixels = (mask: Json): readonly number[] =>
  list(mask.pixels).filter((id): id is number => typeof id === 'number');

/** A point of an opacity curve: seconds since the layer began, and the share that shows, 0 to 1. */
export type CurvePoint = readonly [seconds: number, share: number];

/** The opacity of a layer over time; null: it is one number. */
export function curveOf({ settings }: Layer): readonly CurvePoint[] | null {
  if (!Array.isArray(settings.opacity)) return null;
  return settings.opacity.map((point) => {
    const [seconds, share] = list(point);
    return [number(seconds, 0), number(share, 1)];
  });
}

/** The first curve that the screen offers: in two seconds from dark to `opacity`, 0 to 1. */
export const firstCurve = (opacity: number): readonly CurvePoint[] => [
  [0, 0],
  [2, opacity],
];

/** The curve with another point one second after its last, with the same share. */
export function withPoint(curve: readonly CurvePoint[]): readonly CurvePoint[] {
  const [seconds, share] = curve[curve.length - 1] ?? [0, 1];
  return [...curve, [seconds + 1, share]];
}
