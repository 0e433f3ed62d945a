import { Button, Group, Modal, Text } from '@mantine/core';
import type { FleetRow } from '../api/types.gen';
import { driveQuestion } from '../session/fleetKind';

interface Props {
  opened: boolean;
  /** Counted from 0. */
  frame: number;
  /** The fleet. */
  rows: readonly FleetRow[];
  onDrive: (frame: number) => void;
  onClose: () => void;
}

/** Asks before real robots drive to a frame. */
export function DriveDialog({ opened, frame, rows, onDrive, onClose }: Props) {
  return (
    <Modal opened={opened} onClose={onClose} title={driveQuestion(rows, frame)}>
      <Text mb="lg">The robots leave at once. Make sure that the floor is clear.</Text>
      <Group justify="flex-end">
        <Button variant="default" onClick={onClose}>
          Not now
        </Button>
        <Button
          data-autofocus
          onClick={() => {
            onClose();
            onDrive(frame);
          }}
        >
          Drive robots
        </Button>
      </Group>
    </Modal>
  );
}
