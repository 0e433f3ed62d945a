import { useEditorNow } from './context';
import { marksNow } from './overlay';
import styles from '../stage/stage.module.css';

/** One line under the floor: what a drag measures, or what is wrong and how to mend it. */
export function StageHint() {
  const state = useEditorNow((s) => s);
  const { tooClose, offFloor } = marksNow(state);
  const wrong = [
    tooClose.size > 0 ? `${tooClose.size} pixels are too close to each other (dashed rings)` : '',
    offFloor.size > 0 ? `${offFloor.size} are not on the free floor (crosses)` : '',
  ].filter(Boolean);
  if (state.overlay.hint)
    return (
      <div className={styles.note} aria-hidden>
        {state.overlay.hint}
      </div>
    );
  if (wrong.length === 0) return null;
  return (
    <div className={styles.note} data-wrong role="status">
      {wrong.join('; ')}. Move them, or use Spread apart.
    </div>
  );
}
