import { SegmentedControl, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Speeds of drives that are offered, percent. */
const SPEEDS = [30, 50, 100];

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
      <SegmentedControl
        aria-label="Speed of drives"
        disabled={!idle}
        value={String(percent)}
        onChange={(value) => void ask({ do: 'speed', percent: Number(value) })}
        data={[...new Set([...SPEEDS, percent])]
          .sort((a, b) => a - b)
          .map((speed) => ({ value: String(speed), label: `${speed} %` }))}
      />
      <Text size="xs" c="dimmed">
        Half speed shows a crew and a new floor what the robots will do. Air times stay.
      </Text>
    </Stack>
  );
}
