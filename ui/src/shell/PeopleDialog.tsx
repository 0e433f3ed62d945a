import { Button, Modal, Tabs, Text } from '@mantine/core';
import { useCallback, useEffect, useState } from 'react';
import { listAccounts, removeAccount } from '../api/http';
import type { AccountEntry } from '../api/types.gen';
import { attempt } from '../session/libraryActs';
import { NewPersonForm } from './NewPersonForm';
import { NewTokenForm } from './NewTokenForm';
import { PersonRow } from './PersonRow';
import rows from '../parts/rows.module.css';
import styles from './People.module.css';

type Kind = 'people' | 'tokens';

/** A dialog for people with accounts and for tokens of programs. `me`: the name of this person. */
export function PeopleDialog({ me, onClose }: { me: string; onClose: () => void }) {
  return (
    <Modal opened onClose={onClose} title="People and tokens" size="lg">
      <Tabs defaultValue="people">
        <Tabs.List grow>
          <Tabs.Tab value="people">People</Tabs.Tab>
          <Tabs.Tab value="tokens">Tokens of programs</Tabs.Tab>
        </Tabs.List>
        <Tabs.Panel value="people" pt="md">
          <People me={me} />
        </Tabs.Panel>
        <Tabs.Panel value="tokens" pt="md">
          <Tokens />
        </Tabs.Panel>
      </Tabs>
    </Modal>
  );
}

/** The accounts of a kind, and a function that changes them and then asks for the list again. */
function useAccounts(kind: Kind) {
  const [list, setList] = useState<readonly AccountEntry[]>([]);
  const load = useCallback(() => attempt(() => listAccounts(kind).then(setList)), [kind]);
  useEffect(() => void load(), [load]);
  const act = async (change: () => Promise<unknown>) => {
    const done = await attempt(change);
    await load();
    return done;
  };
  return { list, act };
}

function People({ me }: { me: string }) {
  const { list, act } = useAccounts('people');
  return (
    <>
      <ul className={rows.list} aria-label="People">
        {list.map((person) => (
          <PersonRow key={person.name} person={person} isMe={person.name === me} act={act} />
        ))}
      </ul>
      <NewPersonForm act={act} />
      <Text c="dimmed" size="xs" mt="sm">
        Viewers watch and can stop all robots, editors change shows, operators run them. Sessions
        and tokens of a removed person end at once.
      </Text>
    </>
  );
}

function Tokens() {
  const { list, act } = useAccounts('tokens');
  return (
    <>
      <ul className={rows.list} aria-label="Tokens">
        {list.map(({ name, role }) => (
          <li key={name} className={rows.row}>
            <span className={styles.name}>
              {name} <span className="quiet">{role}</span>
            </span>
            <Button
              size="compact-sm"
              variant="default"
              aria-label={`Revoke the token ${name}`}
              onClick={() => void act(() => removeAccount('tokens', name))}
            >
              Revoke
            </Button>
          </li>
        ))}
      </ul>
      <NewTokenForm act={act} />
    </>
  );
}
