import { useMemo, type PointerEvent } from 'react';
import { beatsBetween, nudged, withBeats, type Beats } from '../../model/beats';
import { momentAt, xOf, type Axis } from '../../model/timelineAxis';
import type { SeenMusic } from '../../music/music';
import { useEditing } from '../context';
import { followPointer } from '../timeline/followPointer';
import type { Drawn } from '../timeline/timelineView';
import { Waveform } from './Waveform';
import styles from './Music.module.css';

interface Props {
  music: SeenMusic;
  beats: Beats | null;
  axis: Axis;
  drawn: Drawn;
}

/** The music on the timeline, as far as it is drawn; a drag moves its beats. */
export function MusicLane({ music: { peaks, lasts_s }, beats, axis, drawn }: Props) {
  const { editor } = useEditing();
  const from_s = Math.max(0, momentAt(axis, drawn.from_px));
  const to_s = Math.min(lasts_s, axis.to_s, momentAt(axis, drawn.to_px));
  const seen = useMemo(
    () => (beats ? beatsBetween(beats, from_s, to_s) : []),
    [beats, from_s, to_s],
  );
  if (to_s <= from_s) return null;
  const press = (event: PointerEvent) => {
    if (!beats || event.button !== 0) return;
    editor.begin();
    followPointer(event, null, {
      move: (by_px) =>
        editor.change('Drag beats', (show) => withBeats(show, nudged(beats, by_px / axis.scale))),
      end: () => editor.commit('Drag beats'),
      cancel: editor.cancel,
    });
  };
  const [left, width] = [xOf(axis, from_s), (to_s - from_s) * axis.scale];
  return (
    <div
      className={styles.lane}
      style={{ left, width }}
      title={beats ? 'Drag to move the beats' : undefined}
      data-testid="timeline-music"
      // The panel Show moves beats by buttons.
      aria-hidden
      onPointerDown={press}
    >
      <Waveform
        peaks={peaks}
        beats={seen}
        from_s={from_s}
        to_s={to_s}
        at_s={null}
        columns={Math.ceil(width / 2)}
      />
    </div>
  );
}
