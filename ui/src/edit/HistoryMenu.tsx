import { ActionIcon, Menu } from '@mantine/core';
import { IconListDetails } from '@tabler/icons-react';
import { useEffect, useRef } from 'react';
import { useEditing, useEditor } from './context';
import styles from './HistoryMenu.module.css';

/** The changes that the history keeps, newest first, undone ones too; a click goes to the state after that change. */
export function HistoryMenu() {
  const isEmpty = useEditor((s) => s.history.past.length + s.history.future.length === 0);
  return (
    <Menu position="top-start" width={260} withInitialFocusPlaceholder={false}>
      <Menu.Target>
        <ActionIcon
          variant="subtle"
          color="gray"
          size="lg"
          aria-label="History"
          title="History: every change since the show was opened"
          disabled={isEmpty}
        >
          <IconListDetails size={18} />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown className={styles.list} aria-label="History">
        <States />
      </Menu.Dropdown>
    </Menu>
  );
}

function States() {
  const { editor } = useEditing();
  const { past, future } = useEditor((s) => s.history);
  const frames = useEditor((s) => s.show.frames).length;
  const list = useRef<HTMLDivElement>(null);
  // Changes that were undone are above: the list begins where the show is now.
  useEffect(() => {
    list.current?.querySelector('[aria-checked=true]')?.scrollIntoView({ block: 'nearest' });
  }, []);
  const marks = [...past, ...[...future].reverse()];
  const state = (changes: number, label: string, frame: number | null) => (
    <Menu.RadioItem
      key={changes}
      value={String(changes)}
      data-undone={changes > past.length || undefined}
      className={styles.state}
      rightSection={
        frame === null || frames === 1 ? null : (
          <span className={styles.frame}>frame {frame + 1}</span>
        )
      }
    >
      {label}
    </Menu.RadioItem>
  );
  return (
    <Menu.RadioGroup
      value={String(past.length)}
      onChange={(changes) => editor.travelTo(Number(changes))}
    >
      <div ref={list}>
        {marks.map((mark, i) => state(i + 1, mark.label, mark.frame)).reverse()}
        {state(0, 'As it was opened', null)}
      </div>
    </Menu.RadioGroup>
  );
}
