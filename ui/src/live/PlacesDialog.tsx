import { Button, Group, Modal, Stack, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useStore } from '../base/store';
import { createFullPlan } from '../session/fullPlan';
import {
  comparePlaces,
  placedRobots,
  placesVerdict,
  startsOf,
  type Comparison,
} from '../session/places';
import { useSession } from '../session/session';
import { DriveHome, TakeLayout } from './PlacesActs';
import { PlacesMap } from './PlacesMap';
import styles from './Preflight.module.css';

/** Time between two looks at where robots stand, milliseconds. */
const EVERY_MS = 500;
/** Most robots elsewhere, and most of unknown place, that are listed. */
const LISTED_MAX = 50;

/** Compares where robots stand with where the show expects them, and offers what to do about it. */
export function PlacesDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  return (
    <Modal opened={opened} onClose={onClose} title="Compare places" size="lg">
      <Places onClose={onClose} />
    </Modal>
  );
}

function Places({ onClose }: { onClose: () => void }) {
  const { live } = useSession();
  const [full] = useState(() => createFullPlan(live.plan));
  useEffect(() => full.follow(), [full]);
  const starts = startsOf(useStore(full.plan));
  const show = useStore(live.opened, (o) => o.show);
  const robots = usePlaced();
  const found = starts && comparePlaces(starts, ...robots);
  return (
    <Stack>
      {show === null || !found ? (
        <Text role="status">
          {show === null
            ? 'Open a show first.'
            : 'Its starting places are known once the show is planned.'}
        </Text>
      ) : (
        <>
          <Text fw={600} role="status" data-testid="places-verdict">
            {placesVerdict(found)}
          </Text>
          <PlacesMap stage={show.stage} found={found} />
          <Away found={found} />
          <Text size="sm" c="dimmed">
            Play drives robots from wherever they stand. Home takes them to the starting places; or
            the show begins from where they stand now.
          </Text>
        </>
      )}
      <Group justify="flex-end">
        <Button variant="default" onClick={onClose}>
          Close
        </Button>
        <TakeLayout robots={robots} places={starts?.length ?? Infinity} onClose={onClose} />
        <DriveHome isNeeded={(found?.away.length ?? 0) > 0} onClose={onClose} />
      </Group>
    </Stack>
  );
}

/** Where robots stand, as `placedRobots` gives it, read anew every `EVERY_MS`. */
function usePlaced() {
  const { live } = useSession();
  const [robots, setRobots] = useState<ReturnType<typeof placedRobots>>([[], []]);
  useEffect(() => {
    const look = () => setRobots(placedRobots(live.fleet.get(), live.track.latest()));
    look();
    const timer = setInterval(look, EVERY_MS);
    return () => clearInterval(timer);
  }, [live]);
  return robots;
}

function Away({ found: { away, unknown } }: { found: Comparison }) {
  const left = away.length - LISTED_MAX;
  return (
    <ul className={styles.named} aria-label="Robots elsewhere">
      {away.slice(0, LISTED_MAX).map(({ name, off_m }) => (
        <li key={name}>
          <strong>{name}</strong>
          <span>{off_m === null ? 'no free place' : `${(off_m * 100).toFixed(0)} cm away`}</span>
        </li>
      ))}
      {left > 0 ? <li>and {left} more</li> : null}
      {unknown.slice(0, LISTED_MAX).map((name) => (
        <li key={name}>
          <strong>{name}</strong>
          <span>place unknown: bring it into sight of the positioning</span>
        </li>
      ))}
    </ul>
  );
}
