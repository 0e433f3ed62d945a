import {
  Button,
  Group,
  PasswordInput,
  SegmentedControl,
  Stack,
  Text,
  Textarea,
  TextInput,
} from '@mantine/core';
import { useEffect, useState } from 'react';
import { getBroker } from '../api/http';
import type { BrokerSettings } from '../api/types.gen';
import { useStore } from '../base/store';
import { connectOf, fieldsOf, usesTls, type BrokerFields } from './brokerForm';
import { brokerText } from './brokerWords';
import { attempt } from '../session/libraryActs';
import { useSession } from '../session/session';

/** A form for the broker and how it is reached, with the state of the connection; nothing until it is loaded. */
export function BrokerSection() {
  const { live, link, ask } = useSession();
  const broker = useStore(live.broker);
  const [settings, setSettings] = useState<BrokerSettings>();
  const [fields, setFields] = useState<BrokerFields>();
  const [refused, setRefused] = useState<string | null>(null);
  useEffect(() => {
    void attempt(async () => {
      const found = await getBroker();
      setSettings(found);
      setFields(fieldsOf(found));
    });
  }, []);
  if (!settings || !fields) return null;
  const set = (change: Partial<BrokerFields>) => setFields({ ...fields, ...change });
  const operation = connectOf(fields);
  return (
    <form
      aria-label="Broker"
      onSubmit={(event) => {
        event.preventDefault();
        if (operation) void link.operate(operation).then(({ error }) => setRefused(error));
      }}
    >
      <Stack gap="xs">
        <Text size="sm" fw={500}>
          Broker
        </Text>
        {settings.embedded === null ? null : (
          <SegmentedControl
            aria-label="Which broker"
            value={fields.own ? 'own' : 'other'}
            onChange={(value) => set({ own: value === 'own' })}
            data={[
              { value: 'own', label: 'Built-in' },
              { value: 'other', label: 'External' },
            ]}
          />
        )}
        {fields.own ? (
          <Text size="sm" c="dimmed">
            Robots connect to {settings.embedded}.
          </Text>
        ) : (
          <OtherBroker settings={settings} fields={fields} set={set} />
        )}
        <Text size="sm" role="status" data-testid="broker" data-phase={broker.phase}>
          {brokerText(broker)}
        </Text>
        {refused ? (
          <Text size="sm" c="bad" role="alert">
            {refused}
          </Text>
        ) : null}
        <Group justify="flex-end">
          <Button
            variant="default"
            disabled={broker.phase === 'off'}
            onClick={() => void ask({ do: 'disconnect' })}
          >
            Disconnect
          </Button>
          <Button type="submit" disabled={operation === null}>
            Connect
          </Button>
        </Group>
      </Stack>
    </form>
  );
}

interface OtherProps {
  settings: BrokerSettings;
  fields: BrokerFields;
  set: (change: Partial<BrokerFields>) => void;
}

function OtherBroker({ settings, fields, set }: OtherProps) {
  const pem = (label: string, field: 'ca' | 'clientCert' | 'clientKey', placeholder: string) => (
    <Textarea
      label={label}
      placeholder={placeholder}
      autosize
      maxRows={4}
      spellCheck={false}
      value={fields[field]}
      onChange={(event) => set({ [field]: event.currentTarget.value })}
    />
  );
  return (
    <>
      <TextInput
        label="Address"
        description="mqtt://host:1883, or mqtts://host:8883 with TLS; several with commas between"
        placeholder="mqtt://192.168.1.10:1883"
        value={fields.address}
        onChange={(event) => set({ address: event.currentTarget.value })}
      />
      <Group grow align="start">
        <TextInput
          label="User"
          autoComplete="off"
          value={fields.user}
          onChange={(event) => set({ user: event.currentTarget.value })}
        />
        <PasswordInput
          label="Password"
          autoComplete="new-password"
          placeholder={settings.has_password ? 'kept on the server' : ''}
          value={fields.password}
          onChange={(event) => set({ password: event.currentTarget.value })}
        />
      </Group>
      {usesTls(fields.address) ? (
        <details>
          <summary>Certificates</summary>
          <Stack gap="xs" pt="xs">
            <Text size="xs" c="dimmed">
              The text of a PEM file, or where it is on the server’s machine. Empty: what the
              server’s system trusts.
            </Text>
            {pem('Authority to trust', 'ca', '')}
            {pem('Own certificate', 'clientCert', '')}
            {pem('Its key', 'clientKey', settings.has_client_key ? 'kept on the server' : '')}
          </Stack>
        </details>
      ) : null}
    </>
  );
}
