import { Button, FileButton, Text } from '@mantine/core';
import { useState, type DragEvent } from 'react';
import { useStore } from '../base/store';
import type { Making } from '../make/making';
import { useEditing } from './context';
import { takeFile } from './makes';
import styles from './Make.module.css';

/** A file to make the frame from: chosen, or dropped here. */
export function FileFields({ making }: { making: Making }) {
  const editing = useEditing();
  const file = useStore(making.draft, (draft) => draft.file);
  const [problem, setProblem] = useState<string | null>(null);
  const [over, setOver] = useState(false);
  const take = async (chosen: File | null | undefined) => {
    if (chosen) setProblem(await takeFile(editing, making, chosen));
  };
  const hover = (isOver: boolean) => (event: DragEvent) => {
    event.preventDefault();
    setOver(isOver);
  };
  return (
    <div
      className={styles.drop}
      data-over={over || undefined}
      onDragOver={hover(true)}
      onDragLeave={hover(false)}
      onDrop={(event) => {
        hover(false)(event);
        // The page would open the file as a show.
        event.stopPropagation();
        void take(event.dataTransfer.files[0]);
      }}
    >
      <Text size="sm" fw={file ? 600 : undefined}>
        {file ? file.name : 'Drop a file here'}
      </Text>
      <FileButton
        accept=".svg,.png,.jpg,.jpeg,.webp,.csv,image/svg+xml,image/png,image/jpeg,image/webp,text/csv"
        onChange={(chosen) => void take(chosen)}
        inputProps={{ 'aria-label': 'File' }}
      >
        {(props) => (
          <Button size="xs" variant="default" {...props}>
            {file ? 'Choose another file…' : 'Choose a file…'}
          </Button>
        )}
      </FileButton>
      <Text size="xs" c="dimmed">
        An SVG drawing, a picture (PNG, JPEG, WebP), or a list of places and colours (CSV)
      </Text>
      {problem === null ? null : (
        <Text size="xs" role="alert">
          {problem}
        </Text>
      )}
    </div>
  );
}
