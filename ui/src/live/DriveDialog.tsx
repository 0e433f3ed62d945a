import { Button, Group, Modal, Text } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../base/store';
import { driveNow } from '../session/drives';
import { driveQuestion, type DriveGoal } from '../session/fleetKind';
import { useSession } from '../session/session';

/** Asks before real robots drive to a frame or to their starting places. */
export function DriveDialog() {
  const session = useSession();
  const goal = useStore(session.driveAsked);
  // The goal of the question, kept while the dialog closes.
  const [asked, setAsked] = useState<DriveGoal>(0);
  if (goal !== null && goal !== asked) setAsked(goal);
  const rows = useStore(session.live.fleet, (fleet) => fleet.rows);
  const close = () => session.driveAsked.set(null);
  return (
    <Modal opened={goal !== null} onClose={close} title={driveQuestion(rows, asked)}>
      <Text mb="lg">The robots leave at once. Make sure that the floor is clear.</Text>
      <Group justify="flex-end">
        <Button variant="default" onClick={close}>
          Not now
        </Button>
        <Button
          data-autofocus
          onClick={() => {
            close();
            driveNow(session, asked);
          }}
        >
          Drive robots
        </Button>
      </Group>
    </Modal>
  );
}
