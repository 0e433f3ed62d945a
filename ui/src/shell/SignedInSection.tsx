import { Button, Group, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { Gate } from '../parts/Gate';
import { signedIn, signOut, type SignedIn } from '../session/signedIn';
import { PeopleDialog } from './PeopleDialog';

/** The signed-in person, sign-out, and for operators the list of people; nothing where sign-in is not asked for. */
export function SignedInSection() {
  const [person, setPerson] = useState<SignedIn | null>(null);
  const [people, setPeople] = useState(false);
  useEffect(() => {
    void signedIn().then(setPerson);
  }, []);
  if (person === null) return null;
  return (
    <Group justify="space-between">
      <Text size="sm">
        Signed in as {person.name} ({person.role})
      </Text>
      <Gate needs="operator" act="change people and tokens">
        <Button size="compact-sm" variant="default" onClick={() => setPeople(true)}>
          People and tokens…
        </Button>
      </Gate>
      <Button size="compact-sm" variant="default" onClick={() => void signOut()}>
        Sign out
      </Button>
      {people ? <PeopleDialog me={person.name} onClose={() => setPeople(false)} /> : null}
    </Group>
  );
}
