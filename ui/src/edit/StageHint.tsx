import { UnstyledButton } from '@mantine/core';
import { useStore } from '../base/store';
import * as acts from './acts';
import { useEditing, useEditorNow } from './context';
import { marksNow } from './overlay';
import styles from '../stage/stage.module.css';

/** One line at the lower edge of the stage: the hint of a gesture, else which pixels are wrong and how to fix them. */
export function StageHint() {
  const state = useEditorNow((s) => s);
  const editing = useEditing();
  const isMaking = useStore(editing.making, (making) => making !== null);
  const { tooClose, offFloor } = marksNow(state);
  const wrong = [
    tooClose.size > 0 ? `${tooClose.size} pixels are too close to each other (dashed rings)` : '',
    offFloor.size > 0
      ? `${offFloor.size} pixels are off the floor or in a no-go area (crosses)`
      : '',
  ].filter(Boolean);
  if (state.overlay.hint)
    return (
      <div className={styles.note} aria-hidden>
        {state.overlay.hint}
      </div>
    );
  if (wrong.length === 0 || isMaking) return null;
  return (
    <div className={styles.note} data-wrong role="status">
      {wrong.join('; ')}.{' '}
      {offFloor.size > 0 ? (
        <UnstyledButton className={styles.noteAct} onClick={() => acts.fitToFloor(editing)}>
          Fit to floor
        </UnstyledButton>
      ) : (
        'Move them, or use Spread apart.'
      )}
    </div>
  );
}
