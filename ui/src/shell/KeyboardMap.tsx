import { Group, Modal, SimpleGrid, Stack, Text, Title } from '@mantine/core';
import { KEYS } from './keys';

/** A dialog with the keyboard map. */
export function KeyboardMap({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  return (
    <Modal opened={opened} onClose={onClose} title="Keyboard" size="xl">
      <SimpleGrid cols={{ base: 1, sm: 2 }} spacing="xl">
        {KEYS.map((group) => (
          <Stack key={group.title} gap={6}>
            <Title order={3} size="sm">
              {group.title}
            </Title>
            {group.keys.map(([keys, what]) => (
              <Group key={what} justify="space-between" wrap="nowrap" gap="md">
                <Text size="sm">{what}</Text>
                <span style={{ whiteSpace: 'nowrap' }}>
                  {keys.map((key) => (
                    <kbd key={key} style={{ marginLeft: 4 }}>
                      {key}
                    </kbd>
                  ))}
                </span>
              </Group>
            ))}
          </Stack>
        ))}
      </SimpleGrid>
    </Modal>
  );
}
