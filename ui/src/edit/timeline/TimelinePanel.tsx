import { IconMusic } from '@tabler/icons-react';
import { useEffect, useMemo, useState } from 'react';
import { useStore } from '../../base/store';
import { beatsBetween, type Beat } from '../../model/beats';
import { blocksOf } from '../../model/timelineBlocks';
import { useEditing, useEditorNow } from '../context';
import { useBeats } from '../music/useBeats';
import { MusicLane } from './MusicLane';
import type { TimelineRow } from './Rows';
import { Tracks } from './Tracks';
import { TimelineTools } from './TimelineTools';
import { axisOf, createTimelineView, TimelineContext } from './timelineView';
import styles from './Timeline.module.css';

const NO_BEATS: readonly Beat[] = [];

/** The show over time: frames with drives and cues, layers of light, sections, markers, and music or beats if any. */
export default function TimelinePanel() {
  const editing = useEditing();
  const [view] = useState(() => createTimelineView(editing));
  useEffect(() => view.follow(), [view]);
  const show = useEditorNow((s) => s.show);
  const drives = useStore(view.drives);
  const scale = useStore(view.scale);
  const drawn = useStore(view.drawn);
  const blocks = useMemo(() => blocksOf(show, drives), [show, drives]);
  const axis = useMemo(() => axisOf(show, blocks, scale), [show, blocks, scale]);
  const beats = useBeatsTo(axis.to_s);
  useEffect(() => view.beats.set(beats.map(({ at_s }) => at_s)), [view, beats]);
  const rows: TimelineRow[] = [];
  if (show.music !== null || beats.length > 0)
    rows.push({
      title: show.music ?? 'Beats',
      icon: <IconMusic size={16} />,
      height: 'music',
      lane: <MusicLane beats={beats} axis={axis} drawn={drawn} />,
    });
  return (
    <TimelineContext value={view}>
      <div className={styles.panel} role="group" aria-label="Timeline">
        <TimelineTools />
        <Tracks show={show} blocks={blocks} axis={axis} drawn={drawn} rows={rows} />
      </div>
    </TimelineContext>
  );
}

/** Beats from show time 0 to `to_s`, rounded up to a minute, seconds; the same list until beats or minute change. */
function useBeatsTo(to_s: number): readonly Beat[] {
  const beats = useBeats();
  // A drag that makes the show longer need not list them anew each time.
  const until_s = Math.ceil(to_s / 60) * 60;
  return useMemo(() => (beats ? beatsBetween(beats, 0, until_s) : NO_BEATS), [beats, until_s]);
}
