import { Menu } from '@mantine/core';
import { useStore } from '../base/store';
import { useEditing } from './context';
import { entriesOf, type MenuEntry } from './menuEntries';
import styles from './StageMenu.module.css';

/** The menu of the stage at the pointer: acts for the chosen pixels, or for the floor. */
export function StageMenu() {
  const editing = useEditing();
  const open = useStore(editing.menu);
  if (!open) return null;
  const close = () => editing.menu.set(null);
  return (
    <Menu
      key={`${open.at.x} ${open.at.y}`}
      opened
      onClose={close}
      position="bottom-start"
      offset={2}
      width={230}
      withInitialFocusPlaceholder={false}
      transitionProps={{ duration: 0 }}
    >
      <Menu.Target>
        <button
          type="button"
          tabIndex={-1}
          aria-label="Menu of the stage"
          className={styles.at}
          style={{ left: open.at.x, top: open.at.y }}
        />
      </Menu.Target>
      <Menu.Dropdown
        aria-label={open.about === 'pixels' ? 'Selected pixels' : 'The floor'}
        className={styles.list}
        // The key that opened this menu would also open the browser's.
        onContextMenu={(event) => event.preventDefault()}
      >
        {entriesOf(editing, open.about).map((entry, i) => (
          <Entry key={i} entry={entry} />
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

function Entry({ entry }: { entry: MenuEntry }) {
  if (entry === 'line') return <Menu.Divider />;
  const { label, keys, off, act } = entry;
  return (
    <Menu.Item
      disabled={off}
      onClick={act}
      rightSection={keys ? <span className={styles.keys}>{keys}</span> : null}
    >
      {label}
    </Menu.Item>
  );
}
