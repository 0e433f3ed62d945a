import {
  Button,
  Group,
  Modal,
  PasswordInput,
  SegmentedControl,
  Stack,
  Text,
  TextInput,
  useMantineColorScheme,
} from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../base/store';
import { useSession } from './session';

/** Broker and looks. The stage's size belongs to the show and is set in the editor. */
export function SettingsDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  const { live, ask } = useSession();
  const broker = useStore(live.broker);
  const version = useStore(live.hello, (hello) => hello?.version);
  const { colorScheme, setColorScheme } = useMantineColorScheme();
  const [address, setAddress] = useState('');
  const [user, setUser] = useState('');
  const [password, setPassword] = useState('');
  const connect = () =>
    void ask({
      do: 'connect',
      address: address.trim() || 'embedded',
      user: user || null,
      password: password || null,
    });
  return (
    <Modal opened={opened} onClose={onClose} title="Settings">
      <Stack>
        <Stack gap={4}>
          <Text size="sm" fw={500}>
            Looks
          </Text>
          <SegmentedControl
            aria-label="Looks"
            value={colorScheme}
            onChange={(value) => setColorScheme(value as 'dark' | 'light' | 'auto')}
            data={[
              { value: 'dark', label: 'Dark' },
              { value: 'light', label: 'Light' },
              { value: 'auto', label: 'As the system' },
            ]}
          />
        </Stack>
        <form
          onSubmit={(event) => {
            event.preventDefault();
            connect();
          }}
        >
          <Stack gap="xs">
            <TextInput
              label="Broker"
              description="mqtt://host:1883, mqtts://host:8883, or empty for the embedded one"
              placeholder={broker.address || 'embedded'}
              value={address}
              onChange={(event) => setAddress(event.currentTarget.value)}
            />
            <Group grow>
              <TextInput
                label="User"
                value={user}
                autoComplete="off"
                onChange={(event) => setUser(event.currentTarget.value)}
              />
              <PasswordInput
                label="Password"
                value={password}
                autoComplete="off"
                onChange={(event) => setPassword(event.currentTarget.value)}
              />
            </Group>
            <Text size="sm" c="dimmed" role="status">
              {broker.connected
                ? `Connected to ${broker.address || 'the embedded broker'}.`
                : `Not connected. ${broker.reason ?? ''}`}
            </Text>
            <Group justify="flex-end">
              <Button variant="default" onClick={() => void ask({ do: 'disconnect' })}>
                Disconnect
              </Button>
              <Button type="submit">Connect</Button>
            </Group>
          </Stack>
        </form>
        <Text size="xs" c="dimmed">
          LightBots {version ?? ''}
        </Text>
      </Stack>
    </Modal>
  );
}
