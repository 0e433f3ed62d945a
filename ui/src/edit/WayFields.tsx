import { Checkbox, SegmentedControl, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { WAYS, type PictureWay } from '../make/draft';
import type { Making } from '../make/making';

const LABELS: Record<PictureWay, string> = {
  auto: 'Auto',
  silhouette: 'Silhouette',
  outline: 'Outline',
  tones: 'Tones',
};

/** What the checkbox does, which depends on what is shown. */
const inversion = (way: PictureWay) =>
  way === 'tones' ? 'Robots where it is dark' : 'The background instead';

/** What of a photograph or an animation the robots show. */
export function WayFields({ making }: { making: Making }) {
  const { way, inverted } = useStore(making.draft);
  return (
    <div>
      <Text size="xs" fw={600} mb={4}>
        Show
      </Text>
      <SegmentedControl
        aria-label="Show"
        size="xs"
        fullWidth
        value={way}
        onChange={(next) => making.change({ way: next as PictureWay })}
        data={WAYS.map((value) => ({ value, label: LABELS[value] }))}
      />
      <Checkbox
        mt="xs"
        size="xs"
        label={inversion(way)}
        checked={inverted}
        onChange={(event) => making.change({ inverted: event.currentTarget.checked })}
      />
    </div>
  );
}
