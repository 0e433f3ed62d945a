import { Text, Title } from '@mantine/core';
import { useStore } from '../base/store';
import { countText } from '../base/numbers';
import { ROBOTS_DEFAULT } from '../session/createShow';
import { fleetKind } from '../session/fleetKind';
import { useSession } from '../session/session';
import styles from './Start.module.css';

/** Says for which robots and which floor a new show is made. `here`: number of rows of the fleet table. */
export function YourFleet({ floor, here }: { floor: string; here: number }) {
  const { live } = useSession();
  const kind = useStore(live.fleet, (fleet) => fleetKind(fleet.rows));
  return (
    <section className={styles.fleet} aria-labelledby="fleet">
      <Title order={2} size="h4" id="fleet">
        Your fleet
      </Title>
      <Text size="sm" c="dimmed">
        {kind === null
          ? `No robot is here yet. New shows are made for ${ROBOTS_DEFAULT} robots; once robots are here, a show can be fitted to them.`
          : `${countText(here, `${kind} robot`)}. New shows have a floor of ${floor}; the tab Show of the editor changes it.`}
      </Text>
    </section>
  );
}
