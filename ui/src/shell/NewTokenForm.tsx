import { Alert, Button, Code, TextInput } from '@mantine/core';
import { useState } from 'react';
import { makeToken } from '../api/http';
import type { Role } from '../session/roles';
import type { Act } from './PersonRow';
import { RoleSelect } from './RoleSelect';
import styles from './People.module.css';

/** A form that makes a token for a program and shows it, because the server does not show it again. */
export function NewTokenForm({ act }: { act: Act }) {
  const [name, setName] = useState('');
  const [role, setRole] = useState<Role>('viewer');
  const [made, setMade] = useState<{ name: string; token: string } | null>(null);
  return (
    <>
      <form
        className={styles.form}
        aria-label="Make a token"
        onSubmit={(event) => {
          event.preventDefault();
          void act(async () => {
            setMade({ name, token: await makeToken({ name, role }) });
            setName('');
          });
        }}
      >
        <TextInput
          label="Name of the program"
          autoComplete="off"
          value={name}
          onChange={(event) => setName(event.currentTarget.value)}
        />
        <RoleSelect label="Role" isShown role={role} onRole={setRole} />
        <Button type="submit" disabled={name === ''}>
          Make a token
        </Button>
      </form>
      {made === null ? null : (
        <Alert mt="md" title={`The token of ${made.name}`} role="status">
          Copy it now: it is shown only this once. A program sends it as{' '}
          <Code>Authorization: Bearer TOKEN</Code>.
          <Code className={styles.secret} mt="xs" data-testid="token">
            {made.token}
          </Code>
        </Alert>
      )}
    </>
  );
}
