import { Button, Checkbox, Group, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { removePoint, withPoint, type DrawnKind } from '../make/drawnLine';
import type { Making } from '../make/making';
import { chooseNextPoint, choosePoint, penLine, setPoints, stopAdding } from '../make/pen';
import { IDLE_PEN } from '../make/penState';
import { LengthInput } from '../parts/LengthInput';
import { useEditing } from './context';
import { addPoint, penFloor } from './penActs';

/** What to do on the floor while a line is drawn, by its kind. */
const HOW: Record<DrawnKind, string> = {
  line: 'Drag on the floor from one end to the other.',
  polyline:
    'Click on the floor for each corner. A double click or Enter ends the line, a click on its first point closes it.',
  curve:
    'Click on the floor for each point. A double click or Enter ends the curve, a click on its first point closes it.',
  freehand: 'Draw on the floor with the pointer held down.',
};

const CHANGE =
  'Drag a point to move it, a small dot to add one. A double click on a point removes it.';

/** Fields for the points of a drawn line, and the place of the chosen point; nothing for other shapes. */
export function PointFields({ making }: { making: Making }) {
  const editing = useEditing();
  useStore(making.draft);
  useStore(making.pen);
  useStore(making.made);
  const line = penLine(making);
  if (!line) return null;
  const { points, chosen, kind } = line;
  const floor = penFloor(editing);
  const set = (next: Parameters<typeof setPoints>[1]) => setPoints(making, next, floor);
  const point = chosen === null ? undefined : points[chosen];
  const clear = () => {
    making.pen.set(IDLE_PEN);
    making.change({ points: [], closed: false, center: null, size_m: null, turn: 0 });
  };
  const small = (label: string, act: () => void, off = false) => (
    <Button size="compact-xs" variant="default" disabled={off} onClick={act}>
      {label}
    </Button>
  );
  return (
    <Stack gap="xs" component="section" aria-label="Points">
      <Text size="xs" c="dimmed">
        {line.isDrawing ? HOW[kind] : kind === 'line' ? 'Drag an end to move it.' : CHANGE}
      </Text>
      <Group gap={6}>
        <Text size="xs" fw={600} role="status" data-testid="points">
          {chosen === null ? countText(points.length) : `Point ${chosen + 1} of ${points.length}`}
        </Text>
        {small('Previous', () => chooseNextPoint(making, -1), points.length === 0)}
        {small('Next', () => chooseNextPoint(making, 1), points.length === 0)}
      </Group>
      <Group grow gap="xs" align="start">
        {(['x', 'y'] as const).map((axis) => (
          <LengthInput
            key={axis}
            label={`Point ${axis}`}
            disabled={!point}
            value={point ? point[axis] : null}
            onChange={(metres) => {
              if (point && chosen !== null)
                set(withPoint(points, chosen, { ...point, [axis]: metres }));
            }}
          />
        ))}
      </Group>
      <Group gap={6}>
        {small(
          'Add a point',
          () => addPoint(editing, making),
          kind === 'line' && points.length > 1,
        )}
        {small(
          'Remove',
          () => {
            if (chosen !== null) set(removePoint(points, chosen));
            choosePoint(making, null);
          },
          chosen === null || points.length < 3,
        )}
        {line.isDrawing && points.length > 1 ? small('Done', () => stopAdding(making)) : null}
        {points.length > 0 ? small('Draw again', clear) : null}
      </Group>
      {kind === 'line' ? null : (
        <Checkbox
          size="xs"
          label="Closed"
          checked={line.closed}
          onChange={(event) => making.change({ closed: event.currentTarget.checked })}
        />
      )}
    </Stack>
  );
}

const countText = (count: number) =>
  count === 0 ? 'No points yet' : count === 1 ? '1 point' : `${count} points`;
