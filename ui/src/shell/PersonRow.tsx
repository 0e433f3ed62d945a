import { Button, PasswordInput } from '@mantine/core';
import { useState } from 'react';
import { changePerson, removeAccount } from '../api/http';
import type { AccountEntry } from '../api/types.gen';
import { RoleSelect } from './RoleSelect';
import rows from '../parts/rows.module.css';
import styles from './People.module.css';

/** Changes accounts and loads their list again; resolves to whether the change was made. A notice says why if not. */
export type Act = (change: () => Promise<unknown>) => Promise<boolean>;

interface Props {
  person: AccountEntry;
  isMe: boolean;
  act: Act;
}

/** A person with an account: choose the role, set a new password, or remove the person. */
export function PersonRow({ person: { name, role }, isMe, act }: Props) {
  const [open, setOpen] = useState<'password' | 'remove' | null>(null);
  return (
    <li>
      <div className={rows.row}>
        <span className={styles.name}>
          {name} {isMe ? <span className="quiet">you</span> : null}
        </span>
        <RoleSelect
          label={`Role of ${name}`}
          role={role}
          onRole={(to) => void act(() => changePerson(name, { role: to }))}
        />
        <Button
          size="compact-sm"
          variant="default"
          aria-label={`New password for ${name}`}
          onClick={() => setOpen('password')}
        >
          New password
        </Button>
        <Button
          size="compact-sm"
          variant="default"
          aria-label={`Remove ${name}`}
          onClick={() => setOpen('remove')}
        >
          Remove
        </Button>
      </div>
      {open === 'password' ? (
        <NewPassword name={name} act={act} onDone={() => setOpen(null)} />
      ) : null}
      {open === 'remove' ? (
        <div className={styles.form}>
          <span>Remove {name}? Sessions and tokens end at once.</span>
          <Button color="bad" onClick={() => void act(() => removeAccount('people', name))}>
            Remove {name}
          </Button>
          <Button variant="default" onClick={() => setOpen(null)}>
            Keep
          </Button>
        </div>
      ) : null}
    </li>
  );
}

function NewPassword({ name, act, onDone }: { name: string; act: Act; onDone: () => void }) {
  const [password, setPassword] = useState('');
  return (
    <form
      className={styles.form}
      onSubmit={(event) => {
        event.preventDefault();
        void act(() => changePerson(name, { password })).then((done) => done && onDone());
      }}
    >
      <PasswordInput
        label={`New password of ${name}`}
        description="At least 8 characters. Open sessions end."
        autoComplete="new-password"
        value={password}
        onChange={(event) => setPassword(event.currentTarget.value)}
      />
      <Button type="submit">Set</Button>
    </form>
  );
}
