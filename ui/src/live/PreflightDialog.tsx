import { Button, Group, Loader, Modal, Stack, Text } from '@mantine/core';
import type { FleetRow, PreflightState } from '../api/types.gen';
import { useStore } from '../base/store';
import { fleetKind } from '../session/fleetKind';
import { preflightDoing, preflightVerdict } from '../session/preflight';
import * as words from '../session/robotWords';
import { useSession } from '../session/session';
import styles from './Preflight.module.css';

/** Explains the test of robots and starts it, shows what they do, and then which robots have faults. */
export function PreflightDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  const { live, ask } = useSession();
  const state = useStore(live.playback, (p) => p.preflight);
  const isReady = useStore(live.playback, (p) => p.phase === 'ready');
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const isReal = fleetKind(rows) === 'real';
  const doing = state?.doing ?? null;
  return (
    <Modal opened={opened} onClose={onClose} title="Preflight" size="lg">
      <Stack>
        {state === null || doing !== null ? <Explanation isReal={isReal} /> : null}
        {state !== null && doing !== null ? <Progress state={state} /> : null}
        {state !== null && doing === null ? <Results state={state} rows={rows} /> : null}
        <Group justify="flex-end">
          <Button variant="default" onClick={onClose}>
            Close
          </Button>
          {doing === null ? (
            <Button disabled={!isReady} onClick={() => void ask({ do: 'preflight' })}>
              {state === null ? '' : 'Again: '}
              {isReal ? 'Drive real robots' : 'Drive robots'}
            </Button>
          ) : (
            <Button color="bad" onClick={() => void ask({ do: 'abort' })}>
              Abort
            </Button>
          )}
        </Group>
      </Stack>
    </Modal>
  );
}

function Explanation({ isReal }: { isReal: boolean }) {
  return (
    <>
      <Text>
        Each robot drives 50 mm out, straight ahead where there is room, is stopped on its way,
        drives back, and blinks. It takes about 20 seconds, longer where robots take turns.
      </Text>
      <Text>
        Robots that stood more than 5 mm or 3° off, or did not stop, are named.{' '}
        {isReal ? 'The robots leave at once. Make sure that the floor is clear.' : null}
      </Text>
    </>
  );
}

function Progress({ state }: { state: PreflightState }) {
  return (
    <Group role="status" data-testid="preflight-progress">
      <Loader size="sm" />
      <Text>{preflightDoing(state)}</Text>
    </Group>
  );
}

function Results({ state, rows }: { state: PreflightState; rows: readonly FleetRow[] }) {
  const named = rows.filter((row) => (row.preflight?.faults.length ?? 0) > 0);
  const limited = rows.filter((row) => row.preflight?.limited).length;
  return (
    <>
      <Text fw={600} role="status" data-testid="preflight-verdict">
        {preflightVerdict(state)}
      </Text>
      {limited > 0 ? (
        <Text size="sm" c="dimmed">
          Stop, heading and blinking were not tested for robots that know TARGET and COLOR only:{' '}
          {limited}.
        </Text>
      ) : null}
      <ul className={styles.named} aria-label="Robots with faults">
        {named.map((row) => (
          <Named key={row.id} row={row} />
        ))}
      </ul>
    </>
  );
}

function Named({ row }: { row: FleetRow }) {
  const { ask } = useSession();
  const canBlink = row.abilities.blink && row.presence === 'active';
  return (
    <li>
      <div>
        <strong>{words.nameOf(row)}</strong>
        {row.preflight?.faults.map(({ cause, remedy }) => (
          <Text key={cause} size="sm">
            It {cause}. {remedy}
          </Text>
        ))}
      </div>
      <Button
        size="compact-sm"
        variant="default"
        disabled={!canBlink}
        onClick={() => void ask({ do: 'identify', robot: row.id })}
      >
        Identify
      </Button>
    </li>
  );
}
