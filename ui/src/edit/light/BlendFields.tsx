import { Button, Select } from '@mantine/core';
import { opacityOf } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { curveOf, firstCurve } from '../../model/masks';
import { useEditing } from '../context';
import { CurveFields } from './CurveFields';
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
  const curve = curveOf(layer);
  const opacity = opacityOf(layer) ?? 1;
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
      {curve ? (
        <CurveFields index={index} curve={curve} />
      ) : (
        <>
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
          <Button
            size="compact-xs"
            variant="default"
            onClick={() => setSettings(editing, index, { opacity: firstCurve(opacity) })}
          >
            Let it change over time
          </Button>
        </>
      )}
    </>
  );
}
