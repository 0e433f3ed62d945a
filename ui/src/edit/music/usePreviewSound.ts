import { messageOf } from '../../base/errors';
import { useEffect } from 'react';
import { useStore } from '../../base/store';
import { musicOf } from '../../model/beats';
import { notify } from '../../session/notices';
import type { Editing } from '../editing';
import { previewSound } from './previewSound';

/** Plays the music with the preview, if that is switched on: second 0 is the start of the first frame's air time. */
export function usePreviewSound({ preview, editor, full, sounding, listening }: Editing) {
  const running = useStore(preview.running);
  const isOn = useStore(previewSound) === 'on';
  useEffect(() => {
    const file = musicOf(editor.state.get().show);
    if (!running || !isOn || !file) return;
    listening.stop();
    sounding.open(file.hash).catch((error: unknown) => {
      notify('error', messageOf(error));
    });
    let request = 0;
    const step = (now_ms: number) => {
      request = requestAnimationFrame(step);
      const at_s = preview.time_s.get();
      const firstDrive_s = full.plan.get()?.transitions[0]?.duration_s ?? 0;
      sounding.follow(at_s === null ? null : at_s - firstDrive_s, now_ms);
    };
    request = requestAnimationFrame(step);
    return () => {
      cancelAnimationFrame(request);
      sounding.follow(null, performance.now());
    };
  }, [running, isOn, preview, editor, full, sounding, listening]);
}
