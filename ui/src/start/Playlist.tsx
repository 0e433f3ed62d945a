import { Button, Switch, Text, Title } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useState } from 'react';
import { putPlaylist } from '../api/http';
import type { PlaylistChange, PlaylistEntry } from '../api/types.gen';
import { countText } from '../base/numbers';
import { useStore } from '../base/store';
import { Gate } from '../parts/Gate';
import { fleetKind } from '../session/fleetKind';
import { attempt } from '../session/libraryActs';
import { nextText, useCountdown, usePlaylist } from '../session/playlist';
import { useSession } from '../session/session';
import { EntryDialog } from './EntryDialog';
import { PlaylistRows } from './PlaylistRows';
import { SwitchDialog } from './SwitchDialog';
import styles from './Playlist.module.css';

/** The playlist: when each show starts by itself, what became of it today, and the switch of the playlist. */
export function Playlist() {
  const { live, ask } = useSession();
  const [seen, take] = usePlaylist();
  const left_s = useCountdown(seen);
  const [asks, setAsks] = useState(false);
  /** Index of the entry that is changed; the number of entries: a new one; null: none. */
  const [edited, setEdited] = useState<number | null>(null);
  const robots = useStore(live.fleet, ({ rows }) => {
    const kind = fleetKind(rows);
    return kind === null ? 'Robots' : countText(rows.length, `${kind} robot`);
  });
  if (seen === null) return null;
  const { state } = seen;
  const change = (wanted: Partial<PlaylistChange>) => {
    const { revision, on, entries } = state;
    return attempt(async () => take(await putPlaylist({ revision, on, entries, ...wanted })));
  };
  const put = async (entry: PlaylistEntry) => {
    const place = edited ?? state.entries.length;
    if (await change({ entries: state.entries.toSpliced(place, 1, entry) })) setEdited(null);
  };
  return (
    <section className={styles.panel} aria-labelledby="playlist">
      <div className={styles.head}>
        <Title order={2} size="h4" id="playlist">
          Playlist
        </Title>
        <span className="quiet">Server time {state.now}</span>
      </div>
      {state.fault === null ? null : (
        <Text size="sm" c="bad" role="alert" className={styles.fault}>
          {state.fault}.
        </Text>
      )}
      <Gate needs="operator" act="change the playlist">
        <Switch
          label="Play by schedule"
          checked={state.on}
          disabled={state.fault !== null}
          onChange={({ currentTarget: { checked } }) => {
            if (checked) setAsks(true);
            else void change({ on: false });
          }}
        />
        {state.held === null ? null : (
          <div className={styles.held} role="status">
            <Text size="sm">{state.held}</Text>
            <Button size="compact-sm" onClick={() => void ask({ do: 'go_on' })}>
              Go on
            </Button>
          </div>
        )}
        {state.entries.length === 0 ? (
          <Text size="sm" c="dimmed">
            Shows that start by themselves, with pauses to charge robots. Add the first one.
          </Text>
        ) : (
          <Text size="sm" data-testid="playlist-next">
            {state.on ? nextText(seen, left_s) : 'Off: no show starts by itself.'}
          </Text>
        )}
        <PlaylistRows
          state={state}
          onChange={(entries) => void change({ entries: [...entries] })}
          onEdit={setEdited}
        />
        <Button
          variant="default"
          leftSection={<IconPlus size={16} />}
          disabled={state.fault !== null}
          onClick={() => setEdited(state.entries.length)}
        >
          Add to the playlist
        </Button>
      </Gate>
      {edited === null ? null : (
        <EntryDialog
          entry={state.entries[edited] ?? null}
          isFirst={edited === 0}
          now={state.now}
          onSave={(entry) => void put(entry)}
          onClose={() => setEdited(null)}
        />
      )}
      {asks ? (
        <SwitchDialog
          state={state}
          robots={robots}
          onYes={() => {
            setAsks(false);
            void change({ on: true });
          }}
          onClose={() => setAsks(false)}
        />
      ) : null}
    </section>
  );
}
