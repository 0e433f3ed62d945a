import { Button, Group, SegmentedControl, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { Gate } from '../parts/Gate';
import { useSession } from '../session/session';

/** Speeds of drives that are offered, percent. */
const SPEEDS = [30, 50, 100];

/** Percent of the usual speed that is offered for a first run. */
const FIRST_RUN = 50;

/** Offers a slow first run if the server says that these robots have not played this show yet. */
function FirstRun() {
  const { live, ask } = useSession();
  const isOffered = useStore(
    live.playback,
    (p) => p.phase === 'ready' && p.first_run && p.speed_percent === 100,
  );
  if (!isOffered) return null;
  return (
    <Group gap="xs" data-testid="first-run">
      <Text size="sm">These robots have not played this show yet. See it slowly first?</Text>
      <Gate needs="operator" act="change the speed">
        <Button
          size="compact-sm"
          variant="default"
          onClick={() => void ask({ do: 'speed', percent: FIRST_RUN })}
        >
          Drive at {FIRST_RUN} %
        </Button>
      </Gate>
    </Group>
  );
}

/** The speed of drives, percent; it can be changed only while the show is ready to play. */
export function SpeedField() {
  const { live, ask } = useSession();
  const percent = useStore(live.playback, (p) => p.speed_percent);
  const idle = useStore(live.playback, (p) => p.phase === 'ready');
  return (
    <Stack gap={4} mt="md">
      <Text size="sm" fw={600}>
        Speed of drives
      </Text>
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
      <Text size="xs" c="dimmed">
        Half speed shows a crew and a new floor what the robots will do. Air times stay.
      </Text>
    </Stack>
  );
}
