import { useEffect, useMemo, useState } from 'react';
import { useStore } from '../../base/store';
import type { Axis } from '../../model/timelineAxis';
import { blocksOf } from '../../model/timelineBlocks';
import { useEditing, useEditorNow } from '../context';
import type { TimelineRow } from './Rows';
import { Tracks } from './Tracks';
import { TimelineTools } from './TimelineTools';
import { axisOf, createTimelineView, TimelineContext, type Drawn } from './timelineView';
import styles from './Timeline.module.css';

interface Props {
  /** Moments of beats that drags snap to, seconds of show time. */
  beats?: readonly number[];
  /** Further rows above the frames, such as the music; they draw what lies in `drawn`. */
  rows?: (axis: Axis, drawn: Drawn) => readonly TimelineRow[];
}

const NO_BEATS: readonly number[] = [];
const NO_ROWS: readonly TimelineRow[] = [];

/** The show over time: frames with their drives, layers of light, sections, markers and cues. */
export default function TimelinePanel({ beats = NO_BEATS, rows }: Props) {
  const editing = useEditing();
  const [view] = useState(() => createTimelineView(editing));
  useEffect(() => view.follow(), [view]);
  useEffect(() => view.beats.set(beats), [view, beats]);
  const show = useEditorNow((s) => s.show);
  const drives = useStore(view.drives);
  const scale = useStore(view.scale);
  const drawn = useStore(view.drawn);
  const blocks = useMemo(() => blocksOf(show, drives), [show, drives]);
  const axis = useMemo(() => axisOf(show, blocks, scale), [show, blocks, scale]);
  return (
    <TimelineContext value={view}>
      <div className={styles.panel} role="group" aria-label="Timeline">
        <TimelineTools />
        <Tracks
          show={show}
          blocks={blocks}
          axis={axis}
          drawn={drawn}
          rows={rows?.(axis, drawn) ?? NO_ROWS}
        />
      </div>
    </TimelineContext>
  );
}
