import { Button, ColorInput, ColorPicker, ColorSwatch, Group, Stack, Text } from '@mantine/core';
import { useState } from 'react';
import { colourName, fromHex, fromText, toHex, type Rgb } from '../base/colour';
import { useStore } from '../base/store';
import * as acts from './acts';
import { useEditing } from './context';

/** Colours to choose from, black among them: the light is off. */
const PALETTE: Rgb[] = [
  0xffffff, 0xffc878, 0xff8c00, 0xff3b1f, 0xff2f92, 0xb14cff, 0x4060ff, 0x18a0ff, 0x00e0c8,
  0x2ee55c, 0xd8f000, 0xffe000, 0x804000, 0x303030, 0x000000,
];

/** Sets the colour of the chosen pixels, or of all when none is chosen; with the fill tool, the fill colour. */
export function ColourSection() {
  const editing = useEditing();
  const color = useStore(editing.color);
  const recent = useStore(editing.recent);
  const isFilling = useStore(editing.tool, (tool) => tool === 'fill');
  const [to, setTo] = useState<Rgb>(0x18a0ff);
  const swatches = (colors: readonly Rgb[]) => (
    <Group gap={5}>
      {colors.map((c) => (
        <ColorSwatch
          key={c}
          component="button"
          type="button"
          size={22}
          color={toHex(c)}
          aria-label={`Colour ${colourName(c)} ${toHex(c)}`}
          onClick={() => acts.chooseColour(editing, c)}
          style={{ cursor: 'pointer' }}
        />
      ))}
    </Group>
  );
  return (
    <Stack gap="xs" component="section" aria-label="Colour">
      <Text size="sm" fw={600}>
        {isFilling ? 'Colour of the fill tool' : 'Colour'}
      </Text>
      {swatches(PALETTE)}
      {recent.length > 0 ? (
        <Group gap="xs">
          <Text size="xs" c="dimmed">
            Recent
          </Text>
          {swatches(recent)}
        </Group>
      ) : null}
      <ColorPicker
        fullWidth
        size="sm"
        value={toHex(color)}
        saturationLabel="Saturation and brightness"
        hueLabel="Hue"
        onChange={(value) => editing.color.set(fromHex(value) ?? color)}
        onChangeEnd={(value) => acts.chooseColour(editing, fromHex(value) ?? color)}
      />
      <ColorInput
        size="xs"
        label="Hex or RGB"
        value={toHex(color)}
        withPicker={false}
        withEyeDropper={false}
        onChange={(value) => {
          const typed = fromText(value);
          if (typed !== undefined && typed !== color) acts.chooseColour(editing, typed);
        }}
      />
      <Group gap="xs" align="end" wrap="nowrap">
        <ColorInput
          size="xs"
          label="Gradient to"
          style={{ flex: 1 }}
          withEyeDropper={false}
          value={toHex(to)}
          onChange={(value) => setTo(fromText(value) ?? to)}
        />
        <Button size="xs" variant="default" onClick={() => acts.paintGradient(editing, color, to)}>
          Apply
        </Button>
      </Group>
    </Stack>
  );
}
