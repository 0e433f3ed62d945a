import { Button, Group, TextInput } from '@mantine/core';
import { useState } from 'react';
import * as acts from './acts';
import { useEditing } from './context';

/** Arranges the chosen pixels, or all, as text. */
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
          aria-label="Text"
          placeholder="Text…"
          maxLength={12}
          value={word}
          onChange={(event) => setWord(event.currentTarget.value)}
          style={{ flex: 1 }}
        />
        <Button size="xs" variant="default" type="submit" disabled={word.trim() === ''}>
          Apply
        </Button>
      </Group>
    </form>
  );
}
