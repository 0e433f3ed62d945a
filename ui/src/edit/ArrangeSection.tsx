import { SimpleGrid, Stack, Text } from '@mantine/core';
import {
  IconArrowsSplit,
  IconFlipHorizontal,
  IconFlipVertical,
  IconLayoutAlignBottom,
  IconLayoutAlignCenter,
  IconLayoutAlignLeft,
  IconLayoutAlignMiddle,
  IconLayoutAlignRight,
  IconLayoutAlignTop,
  IconLayoutDistributeHorizontal,
  IconLayoutDistributeVertical,
  type Icon,
} from '@tabler/icons-react';
import { IconButton } from '../parts/IconButton';
import * as acts from './acts';
import { useEditing } from './context';
import type { Editing } from './editing';

type Act = [string, Icon, (e: Editing) => void];

export const MOVES: Act[] = [
  ['Spread apart', IconArrowsSplit, acts.spread],
  ['Mirror left and right', IconFlipHorizontal, (e) => acts.mirror(e, 'x')],
  ['Mirror top and bottom', IconFlipVertical, (e) => acts.mirror(e, 'y')],
];
const ALIGN: Act[] = [
  ['Align left', IconLayoutAlignLeft, (e) => acts.align(e, 'left')],
  ['Align centres', IconLayoutAlignCenter, (e) => acts.align(e, 'centre')],
  ['Align right', IconLayoutAlignRight, (e) => acts.align(e, 'right')],
  ['Distribute horizontally', IconLayoutDistributeVertical, (e) => acts.distribute(e, 'x')],
  ['Align top', IconLayoutAlignTop, (e) => acts.align(e, 'top')],
  ['Align middles', IconLayoutAlignMiddle, (e) => acts.align(e, 'middle')],
  ['Align bottom', IconLayoutAlignBottom, (e) => acts.align(e, 'bottom')],
  ['Distribute vertically', IconLayoutDistributeHorizontal, (e) => acts.distribute(e, 'y')],
];

/** Arranges the chosen pixels, or all when none is chosen. */
export function ArrangeSection() {
  const editing = useEditing();
  const buttons = (list: Act[], cols: number) => (
    <SimpleGrid cols={cols} spacing={6} verticalSpacing={6}>
      {list.map(([label, Glyph, act]) => (
        <IconButton
          key={label}
          label={label}
          variant="default"
          size="lg"
          w="100%"
          onClick={() => act(editing)}
        >
          <Glyph size={18} />
        </IconButton>
      ))}
    </SimpleGrid>
  );
  return (
    <Stack gap="xs" component="section" aria-label="Arrange">
      <Text size="sm" fw={600}>
        Arrange
      </Text>
      {buttons(MOVES, 3)}
      {buttons(ALIGN, 4)}
    </Stack>
  );
}
