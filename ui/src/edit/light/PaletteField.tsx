import { Button, ColorInput, Text } from '@mantine/core';
import { IconPlus, IconX } from '@tabler/icons-react';
import { fromText, toHex } from '../../base/colour';
import { isUsed, paletteJson, paletteOf, type PaletteColour } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { IconButton } from '../../parts/IconButton';
import { useEditing } from '../context';
import { setSettings } from './lightActs';
import styles from './Light.module.css';

/** Most colours of a palette, as docs/light.md has it. */
const COLOURS_MAX = 64;

/** The colours of a layer in their order; nothing for an effect without a palette. */
export function PaletteField({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  if (!isUsed(layer, 'palette')) return null;
  const palette = paletteOf(layer);
  const { editor } = editing;
  const set = (colours: readonly PaletteColour[]) =>
    setSettings(editing, index, { palette: paletteJson(colours) });
  const recolour = (nth: number, text: string) => {
    const color = fromText(text);
    if (color === undefined || color === palette[nth]?.color) return;
    editor.begin();
    set(palette.map((one, i) => (i === nth ? { ...one, color } : one)));
  };
  return (
    <div>
      <Text size="xs" fw={600} mb={4}>
        Colours
      </Text>
      {palette.map(({ color }, nth) => (
        <div className={styles.pair} key={nth}>
          <ColorInput
            size="xs"
            style={{ flex: 1 }}
            mb={4}
            aria-label={`Colour ${nth + 1} of the layer`}
            withEyeDropper={false}
            value={toHex(color)}
            onChange={(text) => recolour(nth, text)}
            onChangeEnd={() => editor.commit('Colours of light')}
            onBlur={() => editor.commit('Colours of light')}
          />
          <IconButton
            label="Take out"
            name={`Take out colour ${nth + 1}`}
            disabled={palette.length === 1}
            onClick={() => set(palette.filter((_, i) => i !== nth))}
          >
            <IconX size={14} />
          </IconButton>
        </div>
      ))}
      <Button
        size="compact-xs"
        variant="default"
        leftSection={<IconPlus size={12} />}
        disabled={palette.length >= COLOURS_MAX}
        onClick={() => set(withAnother(palette))}
      >
        Another colour
      </Button>
    </div>
  );
}

/** The palette with its last colour once more; if that has a stop, the new one stands at the end, 1. */
function withAnother(palette: readonly PaletteColour[]): readonly PaletteColour[] {
  const last = palette[palette.length - 1] ?? { color: 0xffffff, stop: null };
  return [...palette, last.stop ? { ...last, stop: { ...last.stop, at: 1 } } : last];
}
