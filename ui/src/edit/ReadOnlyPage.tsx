import { Button, Text, Title } from '@mantine/core';
import styles from '../parts/page.module.css';
import { attempt, copyShow } from '../session/libraryActs';
import { openShow } from '../session/openShow';
import { useSession } from '../session/session';

interface Props {
  name: string;
  /** Why the show cannot be saved, and what to do. */
  reason: string;
}

/** In place of the editor: the show's file holds more than this version knows, and saving would lose it. */
export function ReadOnlyPage({ name, reason }: Props) {
  const session = useSession();
  const saveCopy = async () => {
    const copy = await copyShow(name, `${name} copy`);
    await openShow(session, copy);
  };
  return (
    <main className={styles.empty}>
      <Title order={1} size="lg">
        This show can be played, not changed
      </Title>
      <Text maw="40rem">{reason}</Text>
      <Button onClick={() => void attempt(saveCopy)}>Save a copy of what is known</Button>
    </main>
  );
}
