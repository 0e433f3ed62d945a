import { Button, Group, Stack, Text } from '@mantine/core';
import { useMemo } from 'react';
import { boxOf, centreOf } from '../base/geometry';
import { LengthInput } from '../parts/LengthInput';
import { groupOf, groupsOf } from '../model/groups';
import type { Pixel } from '../model/show';
import * as acts from './acts';
import { useEditing, useEditor } from './context';
import { PinField } from './PinField';

/** Number of the chosen pixels, acts that choose and group, and the centre of their bounding box. */
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
        {chosenWords(chosen, state.frames.size)}
      </Text>
      <Group gap={0}>
        {link('All', () => acts.selectAll(editing))}
        {link('None', () => editing.editor.select([]))}
        {link('Invert', () => acts.invertSelection(editing))}
        {link('Same colour', () => acts.selectSameColour(editing))}
        {link('Copy', () => void editing.editor.copy())}
        {link('Paste', () => void editing.editor.paste())}
        {chosen.length > 1 && groupOf(chosen) === null
          ? link('Group', () => acts.group(editing))
          : null}
        {groupsOf(chosen).length > 0 ? link('Ungroup', () => acts.ungroup(editing)) : null}
      </Group>
      <Group grow gap="xs">
        {field('x')}
        {field('y')}
      </Group>
      {only ? <PinField pixel={only} /> : null}
    </Stack>
  );
}

/** What is selected, and what a change of colour applies to. */
function chosenWords(chosen: readonly Pixel[], frames: number): string {
  const [only] = chosen;
  if (!only)
    return frames > 1
      ? `Nothing selected – colours apply to ${frames} frames`
      : 'Nothing selected – changes apply to the whole frame';
  const group = groupOf(chosen);
  const words = chosen.length === 1 ? `Pixel ${only.id}` : `${chosen.length} pixels`;
  return `${group === null ? words : `${group} · ${words}`}${frames > 1 ? ` · ${frames} frames` : ''}`;
}
