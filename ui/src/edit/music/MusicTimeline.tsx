import { IconMusic } from '@tabler/icons-react';
import { useCallback, useMemo } from 'react';
import { useStore } from '../../base/store';
import { beatsBetween, beatsOf } from '../../model/beats';
import type { Axis } from '../../model/timelineAxis';
import { useEditing, useEditorNow } from '../context';
import TimelinePanel from '../timeline/TimelinePanel';
import type { Drawn } from '../timeline/timelineView';
import { MusicLane } from './MusicLane';

const NONE: readonly number[] = [];

/** The timeline with the show's music: a row with the waveform, and beats that drags snap to. */
export default function MusicTimeline() {
  const { music } = useEditing();
  const state = useStore(music.state);
  const seen = state.of === 'ready' ? state.music : null;
  // Other changes of the show leave this part of the document the same object.
  const written = useEditorNow((s) => s.show.rest.beats);
  const beats = useMemo(() => beatsOf({ rest: { beats: written } }), [written]);
  const moments = useMemo(
    () => (beats && seen ? beatsBetween(beats, 0, seen.lasts_s).map(({ at_s }) => at_s) : NONE),
    [beats, seen],
  );
  const rows = useCallback(
    (axis: Axis, drawn: Drawn) =>
      seen
        ? [
            {
              title: 'Music',
              icon: <IconMusic size={16} />,
              height: 'music' as const,
              lane: <MusicLane music={seen} beats={beats} axis={axis} drawn={drawn} />,
            },
          ]
        : [],
    [seen, beats],
  );
  return <TimelinePanel beats={moments} rows={rows} />;
}
