import { IconArrowDown, IconArrowUp, IconPencil, IconTrash } from '@tabler/icons-react';
import { useEffect, useRef, type KeyboardEvent } from 'react';
import type { PlaylistEntry, PlaylistState } from '../api/types.gen';
import { IconButton } from '../parts/IconButton';
import { moved, resultText, startText } from '../session/playlist';
import styles from './Playlist.module.css';

interface Props {
  state: PlaylistState;
  onChange: (entries: readonly PlaylistEntry[]) => void;
  /** Asks for the entry at this index to be changed. */
  onEdit: (place: number) => void;
}

/** The entries in order. Alt with an arrow key up or down moves the entry that has the focus, Delete removes it. */
export function PlaylistRows({ state, onChange, onEdit }: Props) {
  const { entries, today } = state;
  const list = useRef<HTMLOListElement>(null);
  /** Id of an entry that was just moved: it gets the focus back, which moving takes from it. Null: none. */
  const held = useRef<number | null>(null);
  useEffect(() => {
    const id = held.current;
    held.current = null;
    if (id !== null) list.current?.querySelector<HTMLElement>(`[data-entry="${id}"]`)?.focus();
  }, [entries]);
  const move = (place: number, by: -1 | 1) => {
    const next = moved(entries, place, by);
    if (next === entries) return;
    held.current = entries[place]?.id ?? null;
    onChange(next);
  };
  const press = (event: KeyboardEvent, place: number) => {
    const by = { ArrowUp: -1, ArrowDown: 1 }[event.key] as -1 | 1 | undefined;
    if (event.key === 'Delete') onChange(entries.toSpliced(place, 1));
    else if (event.altKey && by) move(place, by);
    else return;
    event.preventDefault();
  };
  if (entries.length === 0) return null;
  return (
    <ol className={styles.rows} aria-label="Playlist" ref={list}>
      {entries.map((entry, place) => {
        const said = today[place];
        const name = `${entry.show}, entry ${place + 1}`;
        return (
          <li
            key={entry.id ?? place}
            data-result={said?.result}
            aria-current={said?.result === 'playing' ? 'step' : undefined}
            onKeyDown={(event) => press(event, place)}
          >
            <div className={styles.words}>
              <b>{entry.show}</b>
              <span>
                {startText(entry)} · {entry.speed_percent} %
              </span>
              {said ? <span className={styles.result}>{resultText(said)}</span> : null}
              {said?.line ? <span className={styles.result}>{said.line}</span> : null}
            </div>
            <div className={styles.acts}>
              <IconButton
                label={`Change ${name}`}
                data-entry={entry.id}
                onClick={() => onEdit(place)}
              >
                <IconPencil size={16} />
              </IconButton>
              <IconButton
                label={`Move ${name} up (Alt ↑)`}
                disabled={place === 0}
                onClick={() => move(place, -1)}
              >
                <IconArrowUp size={16} />
              </IconButton>
              <IconButton
                label={`Remove ${name} (Delete)`}
                onClick={() => onChange(entries.toSpliced(place, 1))}
              >
                <IconTrash size={16} />
              </IconButton>
              <IconButton
                label={`Move ${name} down (Alt ↓)`}
                disabled={place === entries.length - 1}
                onClick={() => move(place, 1)}
              >
                <IconArrowDown size={16} />
              </IconButton>
            </div>
          </li>
        );
      })}
    </ol>
  );
}
