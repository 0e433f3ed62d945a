import { useEffect } from 'react';
import { useStore } from '../../base/store';
import { musicOf } from '../../model/beats';
import { timelineOf } from '../../model/timeline';
import { notify } from '../../session/notices';
import type { Editing } from '../editing';
import { previewSound } from './previewSound';

/** Lets the music be heard with the preview: it begins with the air time of the first frame. */
export function usePreviewSound({ preview, editor, full, sounding, listening }: Editing) {
  const running = useStore(preview.running);
  const isOn = useStore(previewSound) === 'on';
  useEffect(() => {
    const file = musicOf(editor.state.get().show);
    if (!running || !isOn || !file) return;
    listening.stop();
    sounding.open(file.hash).catch((error: unknown) => {
      const why = error instanceof Error ? error.message : String(error);
      notify('error', `The music cannot be heard: ${why}`);
    });
    let request = 0;
    const step = (now_ms: number) => {
      request = requestAnimationFrame(step);
      const at_s = preview.time_s.get();
      const first = timelineOf(editor.state.get().show, full.plan.get())[0];
      sounding.follow(at_s === null ? null : at_s - (first?.shownFrom_s ?? 0), now_ms);
    };
    request = requestAnimationFrame(step);
    return () => {
      cancelAnimationFrame(request);
      sounding.follow(null, performance.now());
    };
  }, [running, isOn, preview, editor, full, sounding, listening]);
}
