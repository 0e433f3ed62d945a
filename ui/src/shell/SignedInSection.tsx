import { Button, Group, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { signedIn, signOut, type SignedIn } from '../session/signedIn';

/** The signed-in person, and sign-out. Nothing where sign-in is not asked for. */
export function SignedInSection() {
  const [person, setPerson] = useState<SignedIn | null>(null);
  useEffect(() => {
    void signedIn().then(setPerson);
  }, []);
  if (person === null) return null;
  return (
    <Group justify="space-between">
      <Text size="sm">
        Signed in as {person.name} ({person.role})
      </Text>
      <Button size="compact-sm" variant="default" onClick={() => void signOut()}>
        Sign out
      </Button>
    </Group>
  );
}
