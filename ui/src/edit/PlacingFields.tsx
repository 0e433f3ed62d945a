import { Button, Group, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { lengthText } from '../base/units';
import { DRAWN } from '../make/drawnLine';
import { STYLES, type Draft, type Style } from '../make/draft';
import type { Making } from '../make/making';
import { LengthInput } from '../parts/LengthInput';
import { useUnit } from '../session/preferences';
import { ChoiceField } from './ChoiceField';
import { useEditor } from './context';
import { SliderField } from './SliderField';

const LABELS: Record<Style, string> = {
  auto: 'Auto',
  filled: 'Filled',
  outline: 'Outline',
  both: 'Both',
  lines: 'Lines',
};

/** Shapes without an inside: lines and dots. */
const WITHOUT_INSIDE = [...DRAWN, 'rings', 'spiral', 'arc', 'wave', 'grid', 'hexagons', 'random'];

const hasInside = ({ tab, shape, files }: Draft) =>
  tab === 'text' ||
  (tab === 'shape' && !WITHOUT_INSIDE.some((known) => known === shape)) ||
  (tab === 'file' && files.some(({ kind }) => kind === 'svg'));

/** Style, size, turn and middle of what is made. */
export function PlacingFields({ making }: { making: Making }) {
  const draft = useStore(making.draft);
  const made_m = useStore(making.made, (made) => made.shown?.pictures[0]?.answer.size_m ?? null);
  const moved = useStore(making.moved, (ids) => ids.length);
  const side_m = useEditor((s) => Math.min(s.show.stage.width_m, s.show.stage.depth_m));
  const unit = useUnit();
  const degrees = Math.round((draft.turn * 180) / Math.PI);
  const center = draft.center ?? { x: 0, y: 0 };
  const size_m = draft.size_m ?? made_m;
  if (draft.tab === 'file' && draft.files.length === 0) return null;
  return (
    <Stack gap="sm">
      {hasInside(draft) ? (
        <ChoiceField
          label="Style"
          value={draft.style}
          values={STYLES}
          labels={LABELS}
          onChange={(style) => making.change({ style })}
        />
      ) : null}
      <SliderField
        label="Size"
        text={size_m === null ? '' : lengthText(size_m, unit)}
        min={0.1}
        max={side_m}
        step={0.01}
        value={size_m ?? side_m / 2}
        onAuto={draft.size_m === null ? undefined : () => making.change({ size_m: null })}
        onChange={(next) => making.change({ size_m: next })}
      />
      <SliderField
        label="Turn"
        text={`${degrees}°`}
        min={-180}
        max={180}
        step={1}
        value={degrees}
        onChange={(next) => making.change({ turn: (next * Math.PI) / 180 })}
      />
      <Group grow gap="xs" align="start">
        {(['x', 'y'] as const).map((axis) => (
          <LengthInput
            key={axis}
            label={`Middle ${axis}`}
            value={center[axis]}
            onChange={(metres) => making.change({ center: { ...center, [axis]: metres } })}
          />
        ))}
      </Group>
      {moved > 0 ? (
        <Group justify="space-between" wrap="nowrap">
          <Text size="xs">
            {moved === 1 ? '1 pixel was' : `${moved} pixels were`} moved by hand and will stay.
          </Text>
          <Button size="compact-xs" variant="default" onClick={making.forgetMoved}>
            Place anew
          </Button>
        </Group>
      ) : null}
    </Stack>
  );
}
