import {
  ActionIcon,
  Button,
  FileButton,
  Group,
  Modal,
  Text,
  TextInput,
  Tooltip,
} from '@mantine/core';
import { IconPlus, IconTrash, IconUpload } from '@tabler/icons-react';
import { useCallback, useEffect, useState } from 'react';
import { deleteShow, listShows } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import { useStore } from '../base/store';
import { createShowInLibrary } from './createShow';
import { tell } from './notices';
import { useSession } from './session';
import { uploadShow } from './upload';
import { goTo } from './useHash';

const explain = (error: unknown) =>
  tell('error', error instanceof Error ? error.message : String(error));

/** Every show on the server: open one, add one, begin one. */
export function LibraryDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  const session = useSession();
  const open = useStore(session.live.opened, (o) => o.name);
  const [entries, setEntries] = useState<ShowEntry[]>([]);
  const [wanted, setWanted] = useState('');
  const load = useCallback(() => void listShows().then(setEntries).catch(explain), []);
  useEffect(() => {
    if (opened) load();
  }, [opened, load]);

  const choose = async (name: string) => {
    const answer = await session.ask({ do: 'open', name });
    if (answer.ok) onClose();
  };
  const shown = entries.filter((entry) =>
    `${entry.name} ${entry.title}`.toLowerCase().includes(wanted.trim().toLowerCase()),
  );
  return (
    <Modal opened={opened} onClose={onClose} title="Shows" size="lg">
      <Group mb="sm" gap="xs">
        <TextInput
          aria-label="Find a show"
          placeholder="Find a show"
          value={wanted}
          onChange={(event) => setWanted(event.currentTarget.value)}
          style={{ flex: 1 }}
          data-autofocus
        />
        <FileButton
          accept=".json,application/json"
          onChange={(file) => {
            if (file) void uploadShow(session, file).then(onClose);
          }}
        >
          {(props) => (
            <Button {...props} variant="default" leftSection={<IconUpload size={16} />}>
              From a file
            </Button>
          )}
        </FileButton>
        <Button
          leftSection={<IconPlus size={16} />}
          onClick={() =>
            void createShowInLibrary(session).then((done) => {
              if (!done) return;
              onClose();
              goTo('edit');
            })
          }
        >
          New show
        </Button>
      </Group>
      <ul className="library-list" aria-label="Shows in the library">
        {shown.map((entry) => (
          <li key={entry.name}>
            <button
              type="button"
              className="entry"
              aria-current={entry.name === open}
              onClick={() => void choose(entry.name)}
            >
              <span>
                {entry.name}
                {entry.title && entry.title.toLowerCase() !== entry.name.toLowerCase() ? (
                  <span className="quiet"> – {entry.title}</span>
                ) : null}
              </span>
              <span className="quiet">
                {entry.frames} frames · {entry.pixels} robots{entry.example ? ' · example' : ''}
              </span>
            </button>
            {entry.example ? null : (
              <Tooltip label="Delete from the library">
                <ActionIcon
                  variant="subtle"
                  color="gray"
                  aria-label={`Delete ${entry.name}`}
                  onClick={() => void deleteShow(entry.name).then(load).catch(explain)}
                >
                  <IconTrash size={16} />
                </ActionIcon>
              </Tooltip>
            )}
          </li>
        ))}
      </ul>
      {shown.length === 0 ? (
        <Text c="dimmed" ta="center" py="lg">
          {entries.length === 0
            ? 'No shows yet. Begin a new one, or drop a file anywhere on the page.'
            : 'No show has that in its name.'}
        </Text>
      ) : (
        <Text c="dimmed" size="xs" mt="md">
          A file can also be dropped anywhere on the page: ours, or the original’s JSON.
        </Text>
      )}
    </Modal>
  );
}
