import { Button, Group, Modal, Stack, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useStore } from '../base/store';
import { useWhyNot } from '../parts/Gate';
import { changeShow } from '../session/changeShow';
import { driveTo } from '../session/drives';
import { createFullPlan } from '../session/fullPlan';
import {
  comparePlaces,
  placedRobots,
  placesVerdict,
  startsOf,
  withStarts,
  type Comparison,
} from '../session/places';
import { useSession } from '../session/session';
import { PlacesMap } from './PlacesMap';
import styles from './Preflight.module.css';

/** Time between two looks at where robots stand, milliseconds. */
const EVERY_MS = 500;
/** Most robots that are listed: the map shows them all. */
const LISTED_MAX = 50;

/** Compares where robots stand with where the show expects them, and offers what to do about it. */
export function PlacesDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  const session = useSession();
  const { live } = session;
  const [full] = useState(() => createFullPlan(live.plan));
  const plan = useStore(full.plan);
  const show = useStore(live.opened, (o) => o.show);
  const readOnly = useStore(live.opened, (o) => o.readOnly);
  const isReady = useStore(live.playback, (p) => p.phase === 'ready');
  const whyNotEdit = useWhyNot('editor', 'change the show');
  const whyNotDrive = useWhyNot('operator', 'drive robots');
  useEffect(() => (opened ? full.follow() : undefined), [full, opened]);
  const robots = usePlaced(opened);
  const starts = startsOf(plan);
  const found = starts && comparePlaces(starts, ...robots);
  const [placed, unknown] = robots;
  const take = () => {
    onClose();
    void changeShow(session, 'Starting places', (now) => withStarts(now, placed));
  };
  return (
    <Modal opened={opened} onClose={onClose} title="Compare places" size="lg">
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
              Play drives robots from wherever they stand. Home takes them to the starting places;
              or the show begins from where they stand now.
            </Text>
          </>
        )}
        <Group justify="flex-end">
          <Button variant="default" onClick={onClose}>
            Close
          </Button>
          <Button
            variant="default"
            disabled={
              !found ||
              placed.length === 0 ||
              unknown.length > 0 ||
              readOnly !== null ||
              whyNotEdit !== null
            }
            title={whyNotEdit ?? undefined}
            onClick={take}
          >
            Take this layout
          </Button>
          <Button
            disabled={!isReady || !found || found.away.length === 0 || whyNotDrive !== null}
            title={whyNotDrive ?? undefined}
            onClick={() => {
              onClose();
              driveTo(session, 'home');
            }}
          >
            Home
          </Button>
        </Group>
      </Stack>
    </Modal>
  );
}

/** Where robots stand, looked at again and again while the dialog is open. */
function usePlaced(opened: boolean) {
  const { live } = useSession();
  const read = () => placedRobots(live.fleet.get(), live.track.latest());
  const [robots, setRobots] = useState(read);
  useEffect(() => {
    if (!opened) return;
    const look = () => setRobots(placedRobots(live.fleet.get(), live.track.latest()));
    look();
    const timer = setInterval(look, EVERY_MS);
    return () => clearInterval(timer);
  }, [live, opened]);
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
