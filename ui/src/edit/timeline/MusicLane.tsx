import { useMemo, type PointerEvent } from 'react';
import { useStore } from '../../base/store';
import { beatsOf, nudged, withBeats, type Beat } from '../../model/beats';
import { momentAt, xOf, type Axis } from '../../model/timelineAxis';
import { useEditing } from '../context';
import { Waveform } from '../music/Waveform';
import { followPointer } from './followPointer';
import type { Drawn } from './timelineView';
import styles from './Timeline.module.css';

interface Props {
  beats: readonly Beat[];
  axis: Axis;
  drawn: Drawn;
}

const SILENCE = new Float32Array(0);
/** Least distance of bars with a number, CSS pixels. */
const NUMBER_PX = 36;

/** The loudness of the music with its bars and beats; a drag moves all beats. Second 0 of the file is show time 0. */
export function MusicLane({ beats, axis, drawn }: Props) {
  const { music, editor } = useEditing();
  const state = useStore(music.state);
  const from_s = Math.max(0, momentAt(axis, drawn.from_px));
  const lasts_s = state.of === 'ready' ? state.music.lasts_s : axis.to_s;
  const to_s = Math.min(lasts_s, axis.to_s, momentAt(axis, drawn.to_px));
  const seen = useMemo(
    () => beats.filter(({ at_s }) => at_s >= from_s && at_s <= to_s),
    [beats, from_s, to_s],
  );
  const bars = useMemo(() => numbered(beats, axis.scale), [beats, axis.scale]);
  if (to_s <= from_s) return null;
  const [left, width] = [xOf(axis, from_s), (to_s - from_s) * axis.scale];
  const press = (event: PointerEvent) => {
    const before = beatsOf(editor.state.get().show);
    if (!before || event.button !== 0) return;
    editor.begin();
    followPointer(event, null, {
      move: (by_px) =>
        editor.change('Drag beats', (show) => withBeats(show, nudged(before, by_px / axis.scale))),
      end: () => editor.commit('Drag beats'),
      cancel: editor.cancel,
    });
  };
  return (
    <div
      className={styles.music}
      style={{ left, width }}
      title={beats.length > 0 ? 'Drag to move the beats' : undefined}
      data-testid="timeline-music"
      // The panel Show moves beats by buttons.
      aria-hidden
      onPointerDown={press}
    >
      <Waveform
        peaks={state.of === 'ready' ? state.music.peaks : SILENCE}
        beats={seen}
        from_s={from_s}
        to_s={to_s}
        at_s={null}
        columns={Math.ceil(width / 2)}
      />
      {bars.map(({ at_s, bar }) =>
        at_s < from_s || at_s > to_s ? null : (
          <span key={bar} className={styles.barNumber} style={{ left: xOf(axis, at_s) - left }}>
            {bar}
          </span>
        ),
      )}
    </div>
  );
}

/** Bars with their numbers, counted from 1: all, or every 2nd, 4th, 8th … so that the numbers have room. */
function numbered(beats: readonly Beat[], scale: number): { at_s: number; bar: number }[] {
  const bars = beats.filter(({ isBar }) => isBar).map(({ at_s }, i) => ({ at_s, bar: i + 1 }));
  const [first, last] = [bars[0], bars[bars.length - 1]];
  if (!first || !last || first === last) return bars;
  const bar_px = ((last.at_s - first.at_s) / (bars.length - 1)) * scale;
  const every = 2 ** Math.max(0, Math.ceil(Math.log2(NUMBER_PX / bar_px)));
  return bars.filter(({ bar }) => (bar - 1) % every === 0);
}
