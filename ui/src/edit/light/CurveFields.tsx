import { Button, Group, Text } from '@mantine/core';
import { IconPlus, IconX } from '@tabler/icons-react';
import { withPoint, type CurvePoint } from '../../model/masks';
import { IconButton } from '../../parts/IconButton';
import { NumberField } from '../../parts/NumberField';
import { useEditing } from '../context';
import { setSettings } from './lightActs';
import styles from './Light.module.css';

/** Most points with fields of their own; a file may have thousands. */
const SHOWN_MAX = 12;
/** Latest point, seconds after the layer began. */
const LONGEST_S = 86_400;

/** The points of a layer's opacity over time, seconds since the layer began. */
export function CurveFields({ index, curve }: { index: number; curve: readonly CurvePoint[] }) {
  const editing = useEditing();
  const set = (opacity: readonly CurvePoint[] | number) => setSettings(editing, index, { opacity });
  const change = (nth: number, point: CurvePoint) =>
    set(curve.map((one, i) => (i === nth ? point : one)));
  const [, last] = curve[curve.length - 1] ?? [0, 1];
  return (
    <div role="group" aria-label="Opacity over time">
      <Text size="xs" fw={600}>
        Opacity over time
      </Text>
      {curve.length > SHOWN_MAX ? (
        <Text size="xs">{curve.length} points, as the file says.</Text>
      ) : (
        curve.map(([seconds, share], nth) => (
          <div className={styles.pair} key={nth}>
            <NumberField
              label={`Point ${nth + 1} (s)`}
              unit=" s"
              min={curve[nth - 1]?.[0] ?? 0}
              max={curve[nth + 1]?.[0] ?? LONGEST_S}
              digits={2}
              step={0.5}
              value={seconds}
              onChange={(to) => change(nth, [to, share])}
            />
            <NumberField
              label="Opacity (%)"
              unit=" %"
              min={0}
              max={100}
              digits={0}
              step={5}
              value={Math.round(share * 100)}
              onChange={(percent) => change(nth, [seconds, percent / 100])}
            />
            <IconButton
              label="Take out"
              name={`Take out point ${nth + 1}`}
              disabled={curve.length === 1}
              onClick={() => set(curve.filter((_, i) => i !== nth))}
            >
              <IconX size={14} />
            </IconButton>
          </div>
        ))
      )}
      <Group gap="xs" mt={4}>
        <Button
          size="compact-xs"
          variant="default"
          leftSection={<IconPlus size={12} />}
          disabled={curve.length >= SHOWN_MAX}
          onClick={() => set(withPoint(curve))}
        >
          Another point
        </Button>
        <Button size="compact-xs" variant="default" onClick={() => set(last)}>
          Make it even
        </Button>
      </Group>
    </div>
  );
}
