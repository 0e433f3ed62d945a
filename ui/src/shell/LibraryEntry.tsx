import { ActionIcon, Menu } from '@mantine/core';
import { IconDots } from '@tabler/icons-react';
import { getState } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import { countText } from '../base/numbers';
import { ExportItems } from '../parts/ExportItems';
import rows from '../parts/rows.module.css';
import { ShowThumbnail } from '../parts/ShowThumbnail';
import { downloadFromLibrary } from '../session/download';
import { attempt, deleteWithUndo } from '../session/libraryActs';
import styles from './Library.module.css';

interface Props {
  entry: ShowEntry;
  /** Whether the show is the one open on the server. */
  open: boolean;
  onOpen: () => void;
  /** Asks for a new name, for a copy or for the show itself. */
  onName: (purpose: 'copy' | 'rename') => void;
  /** Opens the saved states. */
  onStates: () => void;
  onChanged: () => void;
}

const ORIGINS = { example: 'example', start_file: 'start file' } as const;

/** A show of the library, and what can be done with it. */
export function LibraryEntry({ entry, open, onOpen, onName, onStates, onChanged }: Props) {
  const { name } = entry;
  const subtitle =
    entry.title && entry.title.toLowerCase() !== name.toLowerCase() ? ` – ${entry.title}` : '';
  const saved =
    entry.origin === 'saved'
      ? new Date(entry.modified_ms).toLocaleDateString()
      : ORIGINS[entry.origin];
  return (
    <li className={rows.row}>
      <button type="button" className={rows.entry} aria-current={open} onClick={onOpen}>
        <ShowThumbnail version={`${name} ${entry.etag}`} load={() => getState(name, null)} />
        <span className={styles.name}>
          {name}
          <span className="quiet">{subtitle}</span>
        </span>
        <span className="quiet">
          {countText(entry.frames, 'frame')} · {countText(entry.pixels, 'robot')} · {saved}
          {entry.read_only === null ? '' : ' · read-only'}
        </span>
      </button>
      <Menu position="bottom-end" withinPortal>
        <Menu.Target>
          <ActionIcon variant="subtle" color="gray" aria-label={`What to do with ${name}`}>
            <IconDots size={18} />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          <Menu.Item onClick={() => onName('copy')}>Save as…</Menu.Item>
          {entry.origin !== 'saved' ? null : (
            <>
              <Menu.Item onClick={() => onName('rename')}>Rename…</Menu.Item>
              <Menu.Item onClick={onStates}>Earlier saves…</Menu.Item>
            </>
          )}
          <Menu.Divider />
          <ExportItems
            onExport={(format) => void attempt(() => downloadFromLibrary(entry, format))}
          />
          {entry.origin !== 'saved' ? null : (
            <>
              <Menu.Divider />
              <Menu.Item
                color="bad"
                disabled={open}
                onClick={() => void attempt(() => deleteWithUndo(name, onChanged))}
              >
                {open ? 'Delete (open another show first)' : 'Delete'}
              </Menu.Item>
            </>
          )}
        </Menu.Dropdown>
      </Menu>
    </li>
  );
}
