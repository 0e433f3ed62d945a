import { Checkbox } from '@mantine/core';
import { useStore } from '../base/store';
import { WAYS, type PictureWay } from '../make/draft';
import type { Making } from '../make/making';
import { ChoiceField } from './ChoiceField';

const LABELS: Record<PictureWay, string> = {
  auto: 'Auto',
  silhouette: 'Silhouette',
  outline: 'Outline',
  tones: 'Tones',
};

/** Label of the checkbox, by what the robots show. */
const inversion = (way: PictureWay) =>
  way === 'tones' ? 'Robots where it is dark' : 'The background instead';

/** What of a photograph or an animation the robots show. */
export function WayFields({ making }: { making: Making }) {
  const { way, inverted } = useStore(making.draft);
  return (
    <div>
      <ChoiceField
        label="Show"
        value={way}
        values={WAYS}
        labels={LABELS}
        onChange={(next) => making.change({ way: next })}
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
