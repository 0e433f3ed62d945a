import { Button, Group, Select, Text } from '@mantine/core';
import { opacityOf } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { useEditing } from '../context';
import { LayerSlider } from './LayerSlider';
import { setSettings } from './lightActs';

const BLENDS = [
  { value: 'normal', label: 'Covers what is below' },
  { value: 'multiply', label: 'Dims what is below' },
  { value: 'screen', label: 'Brightens what is below' },
  { value: 'add', label: 'Adds' },
  { value: 'subtract', label: 'Takes away' },
  { value: 'darken', label: 'The darker of both' },
  { value: 'lighten', label: 'The lighter of both' },
  { value: 'difference', label: 'The difference of both' },
  { value: 'average', label: 'The middle of both' },
  { value: 'overlay', label: 'Overlay' },
  { value: 'hard-light', label: 'Hard light' },
  { value: 'soft-light', label: 'Soft light' },
];

/** How a layer mixes with those below it, and with the colours of the frame. */
export function BlendFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const opacity = opacityOf(layer);
  return (
    <>
      <Select
        label="Mixing"
        size="xs"
        allowDeselect={false}
        data={BLENDS}
        value={String(layer.settings.blend ?? 'normal')}
        onChange={(blend) => setSettings(editing, index, { blend: blend ?? undefined })}
      />
      {opacity === null ? (
        <Group gap="xs">
          <Text size="xs">Opacity changes over time, as the file says.</Text>
          <Button
            size="compact-xs"
            variant="default"
            onClick={() => setSettings(editing, index, { opacity: 1 })}
          >
            Make it even
          </Button>
        </Group>
      ) : (
        <LayerSlider
          index={index}
          setting="opacity"
          label="Opacity"
          text={`${Math.round(opacity * 100)} %`}
          value={opacity}
          min={0}
          max={1}
          step={0.01}
        />
      )}
    </>
  );
}
