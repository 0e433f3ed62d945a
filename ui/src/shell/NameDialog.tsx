import { Button, Group, Modal, Text, TextInput } from '@mantine/core';
import { useState } from 'react';

interface Props {
  title: string;
  /** The name that the field begins with. */
  name: string;
  /** A text above the field; null: none. */
  note?: string | null;
  /** Uses the typed name; resolves to whether that worked, and then the dialog closes. */
  onName: (name: string) => Promise<boolean>;
  onClose: () => void;
}

/** Asks for the name of a show. */
export function NameDialog({ title, name, note = null, onName, onClose }: Props) {
  const [text, setText] = useState(name);
  const wanted = text.trim();
  return (
    <Modal opened onClose={onClose} title={title}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (wanted !== '')
            void onName(wanted).then((done) => {
              if (done) onClose();
            });
        }}
      >
        {note === null ? null : <Text mb="sm">{note}</Text>}
        <TextInput
          label="Name"
          description="Letters, digits, spaces and . , - _ ( ) ! ' +"
          value={text}
          maxLength={80}
          onChange={(event) => setText(event.currentTarget.value)}
          onFocus={(event) => event.currentTarget.select()}
          data-autofocus
        />
        <Group justify="flex-end" mt="md">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          <Button type="submit" disabled={wanted === ''}>
            Save
          </Button>
        </Group>
      </form>
    </Modal>
  );
}
