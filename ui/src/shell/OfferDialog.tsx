import { Button, Group, Modal, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** A refusal with a way to go on: say why, and let people choose. */
export function OfferDialog() {
  const session = useSession();
  const offer = useStore(session.offer);
  const close = () => session.offer.set(null);
  return (
    <Modal opened={offer !== null} onClose={close} title="Not quite ready" size="md">
      <Text mb="lg">{offer?.reason}</Text>
      <Group justify="flex-end">
        <Button variant="default" onClick={close}>
          Not now
        </Button>
        <Button
          data-autofocus
          onClick={() => {
            const choice = offer?.choice;
            close();
            if (choice) void session.ask(choice.operation);
          }}
        >
          {offer?.choice.label}
        </Button>
      </Group>
    </Modal>
  );
}
