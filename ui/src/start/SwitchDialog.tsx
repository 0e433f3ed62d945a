import { Button, Group, Modal, Text } from '@mantine/core';
import type { PlaylistState } from '../api/types.gen';
import { switchQuestion } from '../session/playlist';

interface Props {
  state: PlaylistState;
  /** The robots that would start, such as `60 real robots`. */
  robots: string;
  onYes: () => void;
  onClose: () => void;
}

/** Asks before the playlist is switched on, so that shows start by themselves. */
export function SwitchDialog({ state, robots, onYes, onClose }: Props) {
  return (
    <Modal opened onClose={onClose} title="Play by schedule?">
      <Text>{switchQuestion(state, robots)}</Text>
      <Text mt="sm" mb="lg">
        Keep people off the floor at these times. The switch stays on when LightBots is started
        again. Stop all holds the playlist until you press Go on.
      </Text>
      <Group justify="flex-end">
        <Button variant="default" onClick={onClose}>
          Not now
        </Button>
        <Button data-autofocus onClick={onYes}>
          Play by schedule
        </Button>
      </Group>
    </Modal>
  );
}
