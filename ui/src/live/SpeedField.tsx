import { Button, Group, SegmentedControl, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { wasPlayed } from '../session/runs';
import { useSession } from '../session/session';
import { Gate } from '../parts/Gate';
import { useRuns } from './useRuns';

/** Speeds of drives that are offered, percent. */
const SPEEDS = [30, 50, 100];

/** Offers a slow first run of a show that was never played here. */
function FirstRun() {
  const { live, ask } = useSession();
  const runs = useRuns();
  const show = useStore(live.opened, (o) => o.show?.name ?? '');
  const isFull = useStore(live.playback, (p) => p.speed_percent === 100);
  if (runs === null || !isFull || wasPlayed(runs, show)) return null;
  return (
    <Group gap="xs" data-testid="first-run">
      <Text size="sm">This show was never played here. See it slowly first?</Text>
      <Button
        size="compact-sm"
        variant="default"
        onClick={() => void ask({ do: 'speed', percent: 50 })}
      >
        Drive at 50 %
      </Button>
    </Group>
  );
}

/** The speed of drives, from the next start on. */
export function SpeedField() {
  const { live, ask } = useSession();
  const percent = useStore(live.playback, (p) => p.speed_percent);
  const idle = useStore(live.playback, (p) => p.phase === 'ready');
  return (
    <Stack gap={4} mt="md">
      <Text size="sm" fw={600}>
        Speed of drives
      </Text>
      <Gate needs="operator" act="change the speed">
        <SegmentedControl
          aria-label="Speed of drives"
          disabled={!idle}
          value={String(percent)}
          onChange={(value) => void ask({ do: 'speed', percent: Number(value) })}
          data={[...new Set([...SPEEDS, percent])]
            .sort((a, b) => a - b)
            .map((speed) => ({ value: String(speed), label: `${speed} %` }))}
        />
        <FirstRun />
      </Gate>
      <Text size="xs" c="dimmed">
        Half speed shows a crew and a new floor what the robots will do. Air times stay.
      </Text>
    </Stack>
  );
}
