import { Button, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { useEditing, useEditor } from './context';
import { openMaking } from './makes';
import styles from '../stage/stage.module.css';

/** A hint over a frame without pixels, unless the Make panel is open. */
export function EmptyFrame() {
  const editing = useEditing();
  const isEmpty = useEditor((s) => s.show.frames[s.frame]?.pixels.length === 0);
  const isMaking = useStore(editing.making, (making) => making !== null);
  if (!isEmpty || isMaking) return null;
  return (
    <div className={styles.hint}>
      <Text mb="sm">This frame is empty. Make it from words, a shape or a file.</Text>
      <Button onClick={() => openMaking(editing)}>Make…</Button>
    </div>
  );
}
