import { Button, Group, Modal, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Shows why the server refused an operation, and the operation that it offers instead. */
export function OfferDialog() {
  const session = useSession();
  const offer = useStore(session.offer);
  const close = () => session.offer.set(null);
  return (
    <Modal opened={offer !== null} onClose={close} title="Before you start" size="md">
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
