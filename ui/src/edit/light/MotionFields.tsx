import { Button, Select } from '@mantine/core';
import { IconDice5 } from '@tabler/icons-react';
import { isUsed, LAYER_KINDS, numberOf, type LayerSetting } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { NumberField } from '../../parts/NumberField';
import { useEditing } from '../context';
import { LayerSlider } from './LayerSlider';
import { setSettings } from './lightActs';

/** Greatest speed of effects on the slider, but not of sparkles, in 1/s: more than three flashes can cause seizures. */
const FLASHES_MAX_HZ = 3;
const WRAPS = [
  { value: 'once', label: 'Once' },
  { value: 'loop', label: 'Over and over' },
  { value: 'mirror', label: 'Back and forth' },
];
const EASES = [
  { value: 'linear', label: 'Even' },
  { value: 'smooth', label: 'Smooth' },
  { value: 'sine', label: 'Like a breath' },
  { value: 'in', label: 'Slow, then fast' },
  { value: 'out', label: 'Fast, then slow' },
];

const percent = (share: number) => `${Math.round(share * 100)} %`;

/** Settings of how a layer moves, of its share of robots and time, and of its random arrangement. */
export function MotionFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const has = (setting: LayerSetting) => isUsed(layer, setting);
  const flashes = layer.kind === 'strobe' || layer.kind === 'pulse';
  const speed = numberOf(layer, 'speed_hz');
  const share = (setting: 'width' | 'density' | 'saturation', label: string) =>
    has(setting) ? (
      <LayerSlider
        {...{ index, setting, label }}
        text={percent(numberOf(layer, setting))}
        value={numberOf(layer, setting)}
        min={setting === 'width' ? 0.01 : 0}
        max={1}
        step={0.01}
      />
    ) : null;
  const word = (setting: 'wrap' | 'ease', label: string, data: typeof WRAPS) =>
    has(setting) ? (
      <Select
        size="xs"
        {...{ label, data }}
        allowDeselect={false}
        value={String(layer.settings[setting] ?? data[0]?.value)}
        onChange={(value) => setSettings(editing, index, { [setting]: value ?? undefined })}
      />
    ) : null;
  return (
    <>
      {has('speed_hz') ? (
        <LayerSlider
          index={index}
          setting="speed_hz"
          label="Speed"
          text={speed === 0 ? 'stands still' : `${speed} in a second`}
          value={speed}
          min={flashes ? 0 : -FLASHES_MAX_HZ}
          max={layer.kind === 'sparkle' ? 20 : FLASHES_MAX_HZ}
          step={0.01}
        />
      ) : null}
      {share(
        'width',
        LAYER_KINDS[layer.kind]?.title === 'Ripple' ? 'Width of the ring' : 'Part that shines',
      )}
      {share('density', 'Robots that light up')}
      {share('saturation', 'Strength of colour')}
      {word('wrap', 'After its end', WRAPS)}
      {word('ease', 'Change', EASES)}
      {has('octaves') ? (
        <NumberField
          label="Detail"
          whole
          min={1}
          max={8}
          value={numberOf(layer, 'octaves')}
          onChange={(octaves) => setSettings(editing, index, { octaves })}
        />
      ) : null}
      {has('top_mps') ? (
        <NumberField
          label="Full at (m/s)"
          unit=" m/s"
          min={0.001}
          max={100}
          digits={3}
          step={0.01}
          value={numberOf(layer, 'top_mps')}
          onChange={(top_mps) => setSettings(editing, index, { top_mps })}
        />
      ) : null}
      {has('seed') ? (
        <Button
          size="compact-xs"
          variant="default"
          leftSection={<IconDice5 size={14} />}
          onClick={() => setSettings(editing, index, { seed: numberOf(layer, 'seed') + 1 })}
        >
          Another arrangement
        </Button>
      ) : null}
    </>
  );
}
