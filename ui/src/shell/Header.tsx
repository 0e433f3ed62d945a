import { Button, SegmentedControl, Tooltip } from '@mantine/core';
import { useEscape } from '../parts/useEscape';
import { useKeys } from '../parts/useKeys';
import {
  IconFolderOpen,
  IconHandStop,
  IconKeyboard,
  IconPlus,
  IconSettings,
} from '@tabler/icons-react';
import { useCallback, useState } from 'react';
import { useStore } from '../base/store';
import { Gate } from '../parts/Gate';
import { IconButton } from '../parts/IconButton';
import { KeyboardMap } from './KeyboardMap';
import { LibraryDialog } from './LibraryDialog';
import { FleetPill, KindPill, LinkPill } from './Pills';
import type { Show } from '../model/show';
import { useSession } from '../session/session';
import type { Shown } from '../session/shown';
import { SettingsDialog } from './SettingsDialog';
import { goTo, type View } from '../session/address';
import styles from './Header.module.css';

type Dialog = 'library' | 'keys' | 'settings' | null;

/** The name in the library of the show in this view, and its title if that differs; null: there is no show. */
function useNames(view: View): { name: string; title: string | null } | null {
  const { live, shown, editing } = useSession();
  const here = useStore<Omit<Shown, 'failure'>>(view === 'edit' ? shown : live.opened);
  const mine = useStore(editing);
  const edited = useStore(mine?.editor.state ?? live.opened, titleOf);
  if (here.name === null) return null;
  const title = (mine?.name === here.name ? edited : (here.show?.name ?? '')).trim();
  const isSame = title.toLowerCase() === here.name.toLowerCase();
  return { name: here.name, title: title === '' || isSame ? null : title };
}

const titleOf = ({ show }: { show: Show | null }) => show?.name ?? '';

/** The header of all views but the audience view: views, shows, states of connection and fleet, settings, Stop all. */
export function Header({ view }: { view: View }) {
  const session = useSession();
  const { ask } = session;
  const [dialog, setDialog] = useState<Dialog>(null);
  const names = useNames(view);
  const close = () => setDialog(null);
  const stopAll = useCallback(() => void ask({ do: 'stop_all' }), [ask]);
  useEscape('shift+Escape', stopAll);
  useKeys([
    ['shift+?', () => setDialog('keys')],
    ['mod+o', () => setDialog('library')],
    ['g', () => goTo(view === 'live' ? 'edit' : 'live')],
  ]);
  return (
    <header className={styles.header}>
      <span className={styles.wordmark}>
        <i aria-hidden />
        <span>LightBots</span>
      </span>
      <SegmentedControl
        className={styles.views}
        size="xs"
        aria-label="View"
        value={view}
        onChange={(value) => goTo(value as View)}
        data={[
          { value: 'live', label: 'Live' },
          { value: 'edit', label: 'Edit' },
        ]}
      />
      <Tooltip label="Open a show (Ctrl O)">
        <Button
          className={styles.show}
          variant="subtle"
          color="gray"
          size="compact-sm"
          leftSection={<IconFolderOpen size={16} />}
          onClick={() => setDialog('library')}
          data-testid="open-library"
        >
          <span className={styles.showName}>
            <span data-testid="show-name">{names?.name ?? 'Open a show'}</span>
            {names?.title ? <span className="quiet"> – {names.title}</span> : null}
          </span>
        </Button>
      </Tooltip>
      <Gate needs="editor" act="make shows">
        <Tooltip label="New show">
          <Button
            variant="subtle"
            color="gray"
            size="compact-sm"
            leftSection={<IconPlus size={16} />}
            onClick={() => goTo('new')}
          >
            New
          </Button>
        </Tooltip>
      </Gate>
      <span className={styles.push} />
      <KindPill />
      <LinkPill />
      <FleetPill />
      <IconButton label="Settings" onClick={() => setDialog('settings')}>
        <IconSettings size={18} />
      </IconButton>
      <IconButton
        className="wide-only"
        label="Keyboard (?)"
        name="Keyboard map"
        onClick={() => setDialog('keys')}
      >
        <IconKeyboard size={18} />
      </IconButton>
      <Tooltip label="Every robot stops; press again to halt at once (Shift Esc)">
        <Button
          className={styles.stopAll}
          data-testid="stop-all"
          color="stop"
          size="sm"
          leftSection={<IconHandStop size={18} />}
          onClick={stopAll}
        >
          Stop all
        </Button>
      </Tooltip>
      <LibraryDialog opened={dialog === 'library'} onClose={close} />
      <KeyboardMap opened={dialog === 'keys'} onClose={close} />
      <SettingsDialog
        opened={dialog === 'settings'}
        onClose={close}
        onKeys={() => setDialog('keys')}
      />
    </header>
  );
}
