import { momentText } from '../../base/time';
import { momentAt, ticksBetween, tickStep_s, xOf, type Axis } from '../../model/timelineAxis';
import { useEditing } from '../context';
import { followPointer } from './followPointer';
import { scrubTo } from './timelineDrag';
import { useTimelineView, type Drawn } from './timelineView';
import styles from './Timeline.module.css';

/** A ruler of show time; a press or a drag puts the moment under the pointer on the stage. */
export function Ruler({ axis, drawn }: { axis: Axis; drawn: Drawn }) {
  const editing = useEditing();
  const view = useTimelineView();
  const isFine = tickStep_s(axis.scale) < 1;
  return (
    <div
      className={styles.ruler}
      data-testid="timeline-ruler"
      // For the keyboard, the slider above the timeline does the same.
      aria-hidden
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        const at_px = event.clientX - event.currentTarget.getBoundingClientRect().left;
        const from_s = momentAt(axis, at_px);
        scrubTo(editing, from_s);
        followPointer(event, view.scroller, {
          move: (by_px) => scrubTo(editing, from_s + by_px / axis.scale),
          end: () => undefined,
          cancel: () => undefined,
        });
      }}
    >
      {ticksBetween(axis, drawn.from_px, drawn.to_px).map((at_s) => (
        <span key={at_s} className={styles.tick} style={{ left: xOf(axis, at_s) }}>
          {isFine ? `${at_s.toFixed(1)} s` : momentText(at_s)}
        </span>
      ))}
    </div>
  );
}
