import { toHex, type Rgb } from '../../base/colour';
import { frameColours } from '../../model/frameColours';
import { LAYER_KINDS, paletteOf } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import type { Pixel } from '../../model/show';

/** A gradient of colours as a style sheet has it; undefined: there is none. */
function gradient(colours: readonly Rgb[]): string | undefined {
  const [first] = colours;
  if (first === undefined) return undefined;
  if (colours.length === 1) return toHex(first);
  return `linear-gradient(90deg, ${colours.map(toHex).join(', ')})`;
}

export const framePaint = (pixels: readonly Pixel[]) => gradient(frameColours(pixels));

/** The colours of a layer; undefined: its effect has colours of its own. */
export const layerPaint = (layer: Layer) =>
  LAYER_KINDS[layer.kind]?.settings.includes('palette')
    ? gradient(paletteOf(layer).map(({ color }) => color))
    : undefined;
