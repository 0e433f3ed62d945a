import { Button, Group, Modal, Text } from '@mantine/core';
import {
  IconAlertTriangle,
  IconCircleCheck,
  IconCircleX,
  IconHourglass,
} from '@tabler/icons-react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { canDrive, canGoOn, isReady, type Check } from '../session/checklist';
import { robotsToFit } from '../session/fitness';
import { checkNow, whenPlanned } from '../session/start';
import { SpeedField } from './SpeedField';
import styles from './StartDialog.module.css';
import { countText } from '../base/numbers';
import { Gate } from '../parts/Gate';

const MARKS = {
  good: [IconCircleCheck, 'Fine'],
  wait: [IconHourglass, 'Not known yet'],
  warn: [IconAlertTriangle, 'Look at it'],
  bad: [IconCircleX, 'Missing'],
} as const;

/** The checklist before a start, kept up to date, with buttons to fit the show, look for robots, and start. */
export function StartDialog() {
  const session = useSession();
  const opened = useStore(session.checking);
  const close = () => session.checking.set(false);
  return (
    <Modal.Root opened={opened} onClose={close} centered size="lg" radius="xl">
      <Modal.Overlay color="var(--veil)" backgroundOpacity={1} blur={2} />
      <Modal.Content>{opened ? <Checklist close={close} /> : null}</Modal.Content>
    </Modal.Root>
  );
}

function Checklist({ close }: { close: () => void }) {
  const session = useSession();
  const { live } = session;
  // The fleet table arrives often and keeps the list up to date.
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  useStore(live.plan);
  const { show, readOnly } = useStore(live.opened);
  const fit = robotsToFit(show, readOnly, rows);
  const idle = useStore(live.playback, (p) => p.phase === 'ready');
  const checks = checkNow(session);
  const ready = isReady(checks);
  const drivers = rows.filter(canDrive).length;
  const play = (missing: 'refuse' | 'leave_out') => {
    close();
    whenPlanned(
      session,
      () => void session.ask({ do: 'play', from: session.frame.get(), missing }),
    );
  };
  return (
    <>
      <Modal.Header>
        <Modal.Title>Before you start</Modal.Title>
        <Modal.CloseButton aria-label="Close" />
      </Modal.Header>
      <Modal.Body>
        <ul className={styles.checklist} aria-label="Checklist">
          {checks.map((check) => (
            <Line key={check.name} check={check} />
          ))}
        </ul>
        <SpeedField />
        <Group justify="flex-end" mt="lg">
          {fit === null ? null : (
            <Button
              variant="default"
              onClick={() => {
                close();
                session.fitting.set(fit);
              }}
            >
              Fit to {countText(fit, 'robot')}…
            </Button>
          )}
          <Gate needs="operator" act="look for robots">
            <Button variant="default" onClick={() => void session.ask({ do: 'refresh' })}>
              Refresh
            </Button>
          </Gate>
          <Button variant="default" onClick={close}>
            Not now
          </Button>
          <Gate needs="operator" act="press Play">
            <Button
              data-autofocus
              disabled={!idle || !canGoOn(checks) || drivers === 0}
              onClick={() => play(ready ? 'refuse' : 'leave_out')}
            >
              {ready || drivers === 0 ? 'Play' : `Play with ${countText(drivers, 'robot')}`}
            </Button>
          </Gate>
        </Group>
      </Modal.Body>
    </>
  );
}

function Line({ check }: { check: Check }) {
  const [Icon, word] = MARKS[check.verdict];
  return (
    <li data-verdict={check.verdict} data-check={check.name}>
      <Icon size={20} aria-label={word} role="img" />
      <div>
        <b>{check.title}</b>
        <Text size="sm" c="dimmed">
          {check.detail}
        </Text>
      </div>
    </li>
  );
}
