import { toHex, type Rgb } from '../../base/colour';
import { frameColours } from '../../model/frameColours';
import { LAYER_KINDS, paletteOf } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import type { Pixel } from '../../model/show';

/** A CSS background with these colours from left to right; undefined: there are none. */
function gradient(colours: readonly Rgb[]): string | undefined {
  const [first] = colours;
  if (first === undefined) return undefined;
  if (colours.length === 1) return toHex(first);
  return `linear-gradient(90deg, ${colours.map(toHex).join(', ')})`;
}

export const framePaint = (pixels: readonly Pixel[]) => gradient(frameColours(pixels));

/** A CSS background in the colours of a layer's palette; undefined: its effect has no palette. */
export const layerPaint = (layer: Layer) =>
  LAYER_KINDS[layer.kind]?.settings.includes('palette')
    ? gradient(paletteOf(layer).map(({ color }) => color))
    : undefined;
