import { Button, Group, Modal, Text } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { startPlay } from '../session/start';
import { isPlayed, jumpQuestion } from './cueRows';

/** Asks before robots drive to a frame that the operator wants to go to. */
export function JumpDialog() {
  const session = useSession();
  const { live, jumpAsked, ask, frame } = session;
  const goal = useStore(jumpAsked);
  // The frame of the question, kept while the dialog closes.
  const [asked, setAsked] = useState(0);
  if (goal !== null && goal !== asked) setAsked(goal);
  const plays = useStore(live.playback, (p) => isPlayed(p.phase));
  const frames = useStore(live.opened, (o) => o.show?.frames) ?? [];
  const close = () => jumpAsked.set(null);
  const go = () => {
    close();
    frame.set(asked);
    if (plays) void ask({ do: 'go_to', frame: asked });
    else startPlay(session);
  };
  return (
    <Modal opened={goal !== null} onClose={close} title={jumpQuestion(frames, asked, plays)}>
      <Text mb="lg">
        {plays
          ? 'Robots leave at once, from where they stand. The show goes on from that frame.'
          : 'Robots drive there from where they stand, and the show goes on from that frame.'}
      </Text>
      <Group justify="flex-end">
        <Button variant="default" onClick={close}>
          Not now
        </Button>
        <Button data-autofocus onClick={go}>
          {plays ? 'Go there' : 'Play'}
        </Button>
      </Group>
    </Modal>
  );
}
