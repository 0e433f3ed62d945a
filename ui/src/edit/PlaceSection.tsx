import { Button, Group, Stack, Text } from '@mantine/core';
import { useMemo } from 'react';
import { boxOf, centreOf } from '../base/geometry';
import { LengthInput } from '../parts/LengthInput';
import * as acts from './acts';
import { useEditing, useEditor } from './context';
import { PinField } from './PinField';

/** Number and exact position of the chosen pixels. */
export function PlaceSection() {
  const editing = useEditing();
  const state = useEditor((s) => s);
  const chosen = useMemo(
    () => state.show.frames[state.frame]?.pixels.filter((p) => state.selection.has(p.id)) ?? [],
    [state.show, state.frame, state.selection],
  );
  const centre = centreOf(boxOf(chosen));
  const only = chosen.length === 1 ? chosen[0] : undefined;
  const field = (axis: 'x' | 'y') => (
    <LengthInput
      label={axis}
      disabled={chosen.length === 0}
      value={chosen.length === 0 ? null : centre[axis]}
      onChange={(metres) => acts.moveTo(editing, axis, metres)}
    />
  );
  const link = (label: string, act: () => void) => (
    <Button size="compact-xs" variant="subtle" color="gray" px={5} onClick={act}>
      {label}
    </Button>
  );
  return (
    <Stack gap="xs" component="section" aria-label="Choice and place">
      <Text size="sm" fw={600} role="status" data-testid="chosen">
        {only
          ? `Pixel ${only.id}`
          : chosen.length === 0
            ? 'Nothing selected – changes apply to the whole frame'
            : `${chosen.length} pixels`}
      </Text>
      <Group gap={0}>
        {link('All', () => acts.selectAll(editing))}
        {link('None', () => editing.editor.select([]))}
        {link('Invert', () => acts.invertSelection(editing))}
        {link('Same colour', () => acts.selectSameColour(editing))}
        {link('Copy', () => void editing.editor.copy())}
        {link('Paste', () => void editing.editor.paste())}
      </Group>
      <Group grow gap="xs">
        {field('x')}
        {field('y')}
      </Group>
      {only ? <PinField pixel={only} /> : null}
    </Stack>
  );
}
