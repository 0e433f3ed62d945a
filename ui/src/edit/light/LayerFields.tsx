import { Checkbox, Select, Stack, Text, TextInput } from '@mantine/core';
import { LAYER_KINDS, titleOf } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { useEditing } from '../context';
import { BlendFields } from './BlendFields';
import { setFields, setSettings } from './lightActs';
import { LayerPictureField } from './LayerPictureField';
import { MaskFields } from './MaskFields';
import { MotionFields } from './MotionFields';
import { PaletteField } from './PaletteField';
import { SpotFields } from './SpotFields';
import { WhenFields } from './WhenFields';

const KINDS = Object.entries(LAYER_KINDS).map(([value, { title }]) => ({ value, label: title }));

/** The settings of the chosen layer. */
export function LayerFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const known = KINDS.some((kind) => kind.value === layer.kind);
  const kinds = known ? KINDS : [...KINDS, { value: layer.kind, label: titleOf(layer) }];
  return (
    <Stack gap="sm" component="section" aria-label={`Layer ${titleOf(layer)}`}>
      <Text size="sm" fw={600}>
        {titleOf(layer)}
      </Text>
      <TextInput
        key={`${index} ${layer.name}`}
        label="Name"
        size="xs"
        maxLength={80}
        placeholder={LAYER_KINDS[layer.kind]?.title}
        defaultValue={layer.name}
        onBlur={(event) => setFields(editing, index, { name: event.currentTarget.value.trim() })}
        onKeyDown={(event) => {
          if (event.key === 'Enter') event.currentTarget.blur();
        }}
      />
      <Select
        label="Effect"
        size="xs"
        allowDeselect={false}
        data={kinds}
        value={layer.kind}
        onChange={(kind) => kind !== null && setFields(editing, index, { kind })}
      />
      <WhenFields index={index} layer={layer} />
      <MaskFields index={index} layer={layer} />
      {layer.kind === 'picture' ? <LayerPictureField index={index} layer={layer} /> : null}
      <PaletteField index={index} layer={layer} />
      <MotionFields index={index} layer={layer} />
      <SpotFields index={index} layer={layer} />
      <BlendFields index={index} layer={layer} />
      <Checkbox
        size="sm"
        label="Goes on while the show waits"
        description="While it waits for GO, is held or is paused"
        checked={layer.settings.runs_freely === true}
        onChange={(event) =>
          setSettings(editing, index, { runs_freely: event.currentTarget.checked || undefined })
        }
      />
    </Stack>
  );
}
