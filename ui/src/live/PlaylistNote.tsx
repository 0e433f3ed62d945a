import { Button } from '@mantine/core';
import { IconCalendarTime } from '@tabler/icons-react';
import { Gate } from '../parts/Gate';
import { goTo } from '../session/address';
import { nextText, useCountdown, usePlaylist } from '../session/playlist';
import { useSession } from '../session/session';
import styles from './Note.module.css';

/** Shown while the playlist is on, which starts shows by itself: what is next and when, or what holds the playlist. */
export function PlaylistNote() {
  const { ask } = useSession();
  const [seen] = usePlaylist();
  const left_s = useCountdown(seen);
  if (!seen?.state.on) return null;
  const { held } = seen.state;
  return (
    <div
      className={styles.note}
      data-tone={held === null ? 'done' : 'stopped'}
      data-testid="playlist-note"
    >
      <IconCalendarTime size={20} aria-hidden />
      <strong>{held ?? `By schedule. ${nextText(seen, left_s)}`}</strong>
      {held === null ? null : (
        <Gate needs="operator" act="go on">
          <Button size="compact-sm" onClick={() => void ask({ do: 'go_on' })}>
            Go on
          </Button>
        </Gate>
      )}
      <Button size="compact-sm" variant="subtle" color="gray" onClick={() => goTo('new')}>
        Playlist
      </Button>
    </div>
  );
}
