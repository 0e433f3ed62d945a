import { ColorInput } from '@mantine/core';
import { fromHex, toHex, type Rgb } from '../base/colour';
import { useStore } from '../base/store';
import type { Making } from '../make/making';

/** Colours that look good as light. */
const SWATCHES: Rgb[] = [
  0xffa500, 0xffffff, 0xffc878, 0xff3b1f, 0xff2f92, 0xb14cff, 0x18a0ff, 0x00e0c8, 0x2ee55c,
  0xffe000,
];

/** Chooses the one colour of the pixels that the Make panel makes. */
export function ColourField({ making }: { making: Making }) {
  const color = useStore(making.draft, (draft) => draft.color);
  return (
    <ColorInput
      label="Colour"
      size="xs"
      eyeDropperButtonProps={{ 'aria-label': 'Take a colour from the screen' }}
      swatches={SWATCHES.map(toHex)}
      swatchesPerRow={10}
      value={toHex(color)}
      onChange={(value) => making.change({ color: fromHex(value) ?? color })}
    />
  );
}
