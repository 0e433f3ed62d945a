import { Button, Text } from '@mantine/core';
import { IconSparkles } from '@tabler/icons-react';
import { sourceWords } from '../make/draft';
import { useEditing, useEditor } from './context';
import { fileName, openMaking, sourceToChange } from './makes';
import styles from './Make.module.css';

/** What the frame on the stage is made from, and the button that opens the Make panel. */
export function MadeFrom() {
  const editing = useEditing();
  const sources = useEditor((s) => s.show.frames[s.frame]?.sources);
  const source = sourceToChange(sources ?? []);
  return (
    <section className={styles.from} aria-label="Made from">
      <Text size="sm" c={source ? undefined : 'dimmed'} className={styles.words}>
        {source
          ? `Made from ${sourceWords(source, fileName(editing, source.asset))}`
          : 'From words, a shape or a file'}
      </Text>
      <Button
        size="xs"
        variant="default"
        data-opens-make
        leftSection={<IconSparkles size={15} />}
        onClick={() => openMaking(editing)}
      >
        {source ? 'Change…' : 'Make…'}
      </Button>
    </section>
  );
}
