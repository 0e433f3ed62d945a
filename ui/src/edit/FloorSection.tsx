import type { Obstacle } from '../base/geometry';
import { ActionIcon, Button, Group, Stack, Text } from '@mantine/core';
import { IconTrash } from '@tabler/icons-react';
import { addObstacle, removeObstacle, setObstacle } from '../model/obstacles';
import { setStage } from '../model/commands';
import { LengthInput } from '../parts/LengthInput';
import { useEditing, useEditor } from './context';
import styles from './FloorSection.module.css';

/** Most no-go areas in the list; the floor shows all. */
const LISTED_MAX = 20;

/** Least radius of a round area, metres. */
const RADIUS_MIN_M = 0.001;

/** Size of the floor, and its no-go areas. */
export function FloorSection() {
  const { editor, tool } = useEditing();
  const stage = useEditor((s) => s.show.stage);
  const size = (label: string, field: 'width_m' | 'depth_m') => (
    <LengthInput
      label={label}
      min={0.2}
      max={200}
      value={stage[field]}
      onChange={(m) => editor.change('Floor', (show) => setStage(show, { [field]: m }))}
    />
  );
  const disc: Obstacle = { kind: 'disc', x: 0, y: 0, radius_m: 0.2 };
  return (
    <Stack gap="xs" component="section" aria-label="Floor">
      <Text size="sm" fw={600}>
        Floor
      </Text>
      <Group grow gap="xs">
        {size('Width', 'width_m')}
        {size('Depth', 'depth_m')}
      </Group>
      <Text size="xs">No-go areas</Text>
      {stage.obstacles.slice(0, LISTED_MAX).map((o, i) => (
        <Area key={i} index={i} area={o} />
      ))}
      {stage.obstacles.length > LISTED_MAX ? (
        <Text size="xs" c="dimmed">
          and {stage.obstacles.length - LISTED_MAX} more on the floor
        </Text>
      ) : null}
      <Group gap="xs">
        <Button size="xs" variant="default" onClick={() => tool.set('area')}>
          Rectangle (O)
        </Button>
        <Button
          size="xs"
          variant="default"
          onClick={() => editor.change('No-go area', (show) => addObstacle(show, disc))}
        >
          Circle
        </Button>
      </Group>
    </Stack>
  );
}

function Area({ index, area }: { index: number; area: Obstacle }) {
  const { editor } = useEditing();
  const set = (next: Obstacle) =>
    editor.change('No-go area', (show) => setObstacle(show, index, next));
  const fields: [string, number, (m: number) => void, min?: number][] =
    area.kind === 'disc'
      ? [
          ['x', area.x, (x) => set({ ...area, x })],
          ['y', area.y, (y) => set({ ...area, y })],
          ['Radius', area.radius_m, (radius_m) => set({ ...area, radius_m }), RADIUS_MIN_M],
        ]
      : [
          ['Left', area.minX, (minX) => set({ ...area, minX })],
          ['Right', area.maxX, (maxX) => set({ ...area, maxX })],
          ['Front', area.minY, (minY) => set({ ...area, minY })],
          ['Back', area.maxY, (maxY) => set({ ...area, maxY })],
        ];
  return (
    <fieldset className={styles.area}>
      <legend>{area.kind === 'disc' ? `Circle ${index + 1}` : `Rectangle ${index + 1}`}</legend>
      <div className={styles.fields}>
        {fields.map(([label, value, onChange, min]) => (
          <LengthInput key={label} label={label} value={value} min={min} onChange={onChange} />
        ))}
      </div>
      <ActionIcon
        variant="subtle"
        color="gray"
        aria-label={`Delete area ${index + 1}`}
        onClick={() => editor.change('No-go area', (show) => removeObstacle(show, index))}
      >
        <IconTrash size={16} />
      </ActionIcon>
    </fieldset>
  );
}
