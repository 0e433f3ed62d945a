import { Button } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../../base/store';
import { beatsOf, PER_BAR, TAPS_LEAST, tapped, withBeats } from '../../model/beats';
import { useEditing } from '../context';

/** A tap this long after the last one, or longer, begins anew, seconds. */
const PAUSE_S = 3;

/** Label of the change in the history. */
const LABEL = 'Tapped beats';

/** A button to press with each beat of the music, from which the tempo is taken. The first press starts the music. */
export function TapButton({ lasts_s }: { lasts_s: number }) {
  const { editor, listening, music } = useEditing();
  const isHeard = useStore(listening.at_s, (at) => at !== null);
  const [taps, setTaps] = useState<readonly number[]>([]);
  const tap = () => {
    const at_s = listening.at_s.get();
    const state = music.state.get();
    if (at_s === null) {
      setTaps([]);
      if (state.of === 'ready') void listening.start(state.music.hash, 0, lasts_s);
      return;
    }
    const last = taps[taps.length - 1];
    const goesOn = last !== undefined && at_s > last && at_s - last < PAUSE_S;
    const all = goesOn ? [...taps, at_s] : [at_s];
    setTaps(all);
    const perBar = beatsOf(editor.state.get().show)?.perBar ?? PER_BAR;
    const beats = tapped(all, perBar);
    if (!beats) return;
    // A further tap replaces the step of the history that the taps before it made.
    const { past } = editor.state.get().history;
    if (all.length > TAPS_LEAST && past[past.length - 1]?.label === LABEL) editor.undo();
    editor.change(LABEL, (show) => withBeats(show, beats));
  };
  const left = Math.max(0, TAPS_LEAST - taps.length);
  const label = !isHeard
    ? 'Tap along'
    : left > 0
      ? `Tap each beat (${left} more)`
      : 'Tap each beat';
  return (
    <Button size="compact-xs" variant={isHeard ? 'light' : 'default'} onClick={tap}>
      {label}
    </Button>
  );
}
