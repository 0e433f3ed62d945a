import { Button, FileButton, Group, Modal, Text, TextInput } from '@mantine/core';
import { IconPlus, IconUpload } from '@tabler/icons-react';
import { useCallback, useEffect, useState } from 'react';
import { ACCEPTED, ENDINGS_IN_WORDS } from '../api/formats';
import { listShows } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import { useStore } from '../base/store';
import { StatesDialog } from '../parts/StatesDialog';
import rows from '../parts/rows.module.css';
import { attempt, copyShow, renameShow } from '../session/libraryActs';
import { LibraryEntry } from './LibraryEntry';
import { NameDialog } from './NameDialog';
import { openShow } from '../session/openShow';
import { useSession } from '../session/session';
import { uploadShow } from '../session/upload';
import { goTo } from '../session/address';
import { Gate } from '../parts/Gate';

/** A dialog with the shows on the server: find, open, copy, rename, import, or go on to begin a new one. */
export function LibraryDialog({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  const session = useSession();
  const open = useStore(session.live.opened, (o) => o.name);
  const [entries, setEntries] = useState<ShowEntry[]>([]);
  const [wanted, setWanted] = useState('');
  const [naming, setNaming] = useState<{ entry: ShowEntry; purpose: 'copy' | 'rename' }>();
  const [past, setPast] = useState<string>();
  const load = useCallback(
    () => void attempt(() => listShows().then((found) => setEntries(found))),
    [],
  );
  useEffect(() => {
    if (opened) load();
  }, [opened, load]);

  const choose = async (name: string) => {
    if (await openShow(session, name)) onClose();
  };
  const begin = () => {
    onClose();
    goTo('new');
  };
  const name = ({ entry, purpose }: NonNullable<typeof naming>, to: string) =>
    attempt(async () => {
      if (purpose === 'rename') await renameShow(session, entry.name, to);
      else await choose(await copyShow(entry.name, to));
      load();
    });
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
        <Gate needs="editor" act="add shows">
          <FileButton
            accept={ACCEPTED}
            onChange={(file) => {
              if (file) void uploadShow(session, file).then(onClose);
            }}
          >
            {(props) => (
              <Button {...props} variant="default" leftSection={<IconUpload size={16} />}>
                Import…
              </Button>
            )}
          </FileButton>
          <Button leftSection={<IconPlus size={16} />} onClick={begin}>
            New show
          </Button>
        </Gate>
      </Group>
      <Gate needs="editor" act="open and change shows">
        <ul className={rows.list} aria-label="Shows in the library">
          {shown.map((entry) => (
            <LibraryEntry
              key={entry.name}
              entry={entry}
              open={entry.name === open}
              onOpen={() => void choose(entry.name)}
              onName={(purpose) => setNaming({ entry, purpose })}
              onStates={() => setPast(entry.name)}
              onChanged={load}
            />
          ))}
        </ul>
      </Gate>
      <Text c="dimmed" size="xs" mt="md">
        {entries.length > 0 && shown.length === 0
          ? 'No show has that in its name.'
          : `You can also drop a file anywhere on the page (${ENDINGS_IN_WORDS}).`}
      </Text>
      {past === undefined ? null : (
        <StatesDialog name={past} onRestored={load} onClose={() => setPast(undefined)} />
      )}
      {naming ? (
        <NameDialog
          title={naming.purpose === 'copy' ? `Save ${naming.entry.name} as` : 'Rename the show'}
          name={naming.purpose === 'copy' ? `${naming.entry.name} copy` : naming.entry.name}
          note={naming.purpose === 'copy' ? naming.entry.read_only : null}
          onName={(to) => name(naming, to)}
          onClose={() => setNaming(undefined)}
        />
      ) : null}
    </Modal>
  );
}
