import { Button, CloseButton, Group, SegmentedControl, Title } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { useStore } from '../base/store';
import type { MakeChoices } from '../api/types.gen';
import type { Tab } from '../make/draft';
import type { Making } from '../make/making';
import { useKeys } from '../parts/useKeys';
import { useEditing } from './context';
import { FileFields } from './FileFields';
import { closeMaking, takeMade } from './makes';
import { MakeVerdict } from './MakeVerdict';
import { OwnShapesField } from './OwnShapesField';
import { PlacingFields } from './PlacingFields';
import { ShapeFields } from './ShapeFields';
import { WordFields } from './WordFields';
import page from '../parts/page.module.css';
import styles from './Make.module.css';

const TABS: { value: Tab; label: string }[] = [
  { value: 'text', label: 'Words' },
  { value: 'shape', label: 'Shape' },
  { value: 'file', label: 'Files' },
];

/** Makes the frame on the stage, and frames after it, from words, a shape or files. The stage shows the result. */
export function MakePanel({ making }: { making: Making }) {
  const editing = useEditing();
  const { editor } = editing;
  const tab = useStore(making.draft, (draft) => draft.tab);
  const canUse = useStore(making.made, ({ answer }) => answer !== null && answer.error === null);
  const count = useStore(making.made, ({ answer }) => answer?.pictures.length ?? 1);
  const choices = useChoices();
  const close = () => closeMaking(editing);
  const form = useFocus();
  useKeys([
    [
      'Escape',
      () => {
        // During a drag on the stage the key ends only the drag, and while points are added only the adding.
        if (!editor.isGesturing() && !making.pen.get().isAdding) close();
      },
    ],
  ]);
  // The panel closes when another frame comes on the stage.
  useEffect(
    () =>
      editor.state.subscribe(() => {
        if (editor.current()?.key !== making.frame) closeMaking(editing);
      }),
    [editing, editor, making],
  );
  return (
    <aside className={page.side} aria-label="Make">
      <form
        ref={form}
        className={styles.panel}
        onSubmit={(event) => {
          event.preventDefault();
          void takeMade(editing, making);
        }}
        onKeyDown={(event) => {
          // An open list of choices uses the key to close itself.
          const isList = (event.target as HTMLElement).ariaExpanded === 'true';
          if (event.key === 'Escape' && !isList) close();
        }}
      >
        <div className={styles.head}>
          <Title order={2} size="sm">
            Make this frame
          </Title>
          <CloseButton aria-label="Close without a change" onClick={close} />
        </div>
        <div className={styles.fields}>
          <SegmentedControl
            aria-label="Made from"
            size="xs"
            value={tab}
            onChange={(value) => making.change({ tab: value as Tab })}
            data={TABS}
          />
          {tab === 'text' ? <WordFields making={making} fonts={choices?.fonts ?? []} /> : null}
          {tab === 'shape' ? <ShapeFields making={making} shapes={choices?.shapes ?? []} /> : null}
          {tab === 'file' ? <FileFields making={making} /> : null}
          <PlacingFields making={making} />
          {tab === 'file' ? null : <OwnShapesField making={making} />}
        </div>
        <div className={styles.foot}>
          <MakeVerdict making={making} />
          <Group grow>
            <Button variant="default" onClick={close}>
              Cancel
            </Button>
            <Button type="submit" disabled={!canUse}>
              {count > 1 ? `Use ${count} frames` : 'Use'}
            </Button>
          </Group>
        </div>
      </form>
    </aside>
  );
}

/** Fonts and shapes that settings may name; null until the module is loaded, and if it cannot be. */
function useChoices(): MakeChoices | null {
  const { maker, choices } = useEditing();
  useEffect(() => {
    // The verdict says what is wrong with the module.
    maker.list().then(choices.set, () => undefined);
  }, [maker, choices]);
  return useStore(choices);
}

/** Focuses the first field when the panel opens; when it closes, the button that opens it, if nothing has focus. */
function useFocus() {
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => {
    form.current?.querySelector<HTMLElement>('[data-first], [aria-pressed=true]')?.focus();
    return () => {
      setTimeout(() => {
        if (document.activeElement === document.body)
          document.querySelector<HTMLElement>('[data-opens-make]')?.focus();
      });
    };
  }, []);
  return form;
}
