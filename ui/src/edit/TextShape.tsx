import { Button, Group, TextInput } from '@mantine/core';
import { useState } from 'react';
import * as acts from './acts';
import { useEditing } from './context';

/** Writes a word with the chosen pixels, or with all. */
export function TextShape() {
  const editing = useEditing();
  const [word, setWord] = useState('');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        acts.write(editing, word);
      }}
    >
      <Group gap="xs" wrap="nowrap">
        <TextInput
          size="xs"
          aria-label="Word to write with pixels"
          placeholder="Write a word, such as HI"
          maxLength={12}
          value={word}
          onChange={(event) => setWord(event.currentTarget.value)}
          style={{ flex: 1 }}
        />
        <Button size="xs" variant="default" type="submit" disabled={word.trim() === ''}>
          Write
        </Button>
      </Group>
    </form>
  );
}
