import { useEffect } from 'react';
import { momentText } from '../../base/time';
import { useStore } from '../../base/store';
import { xOf, type Axis } from '../../model/timelineAxis';
import { momentOnStage, type Block } from '../../model/timelineBlocks';
import { useEditing, useEditorNow } from '../context';
import { reveal, useTimelineView } from './timelineView';
import styles from './Timeline.module.css';

interface Props {
  blocks: readonly Block[];
  axis: Axis;
  /** Whether the playhead shows its moment as text, and keeps itself in sight during a preview. */
  isLabelled?: boolean;
}

/** A line at the moment that the stage shows. A component of its own, because it moves often during a preview. */
export function Playhead({ blocks, axis, isLabelled = false }: Props) {
  const view = useTimelineView();
  const { preview } = useEditing();
  const frame = useEditorNow((s) => s.frame);
  const time_s = useStore(preview.time_s);
  const running = useStore(preview.running);
  const at_s = momentOnStage(blocks, frame, time_s);
  const x = xOf(axis, at_s);
  useEffect(() => {
    if (running && isLabelled) reveal(view, x, x);
  }, [running, isLabelled, view, x]);
  return (
    <div className={styles.playheads} aria-hidden>
      <i className={styles.playhead} style={{ transform: `translateX(${x}px)` }}>
        {isLabelled ? <b>{momentText(at_s)}</b> : null}
      </i>
    </div>
  );
}
