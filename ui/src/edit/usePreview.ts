import { useEffect } from 'react';
import { useStore } from '../base/store';
import { timelineOf } from '../model/timeline';
import type { Editing } from './editing';

/** Longest wait for a plan, milliseconds; after it the preview shows the frames without the drives between them. */
const PLAN_WAIT_MS = 3000;

/** Advances a running preview at each refresh of the screen, and keeps the full plan up to date while one is shown. */
export function usePreview({ preview, editor, full }: Editing) {
  const running = useStore(preview.running);
  const isShown = useStore(preview.time_s, (time_s) => time_s !== null);
  useEffect(() => (running || isShown ? full.follow() : undefined), [running, isShown, full]);
  useEffect(() => {
    if (!running) return;
    const asked_ms = performance.now();
    let before_ms: number | null = null;
    let request = 0;
    const draw = (now_ms: number) => {
      if (!preview.running.get()) return;
      request = requestAnimationFrame(draw);
      const plan = full.plan.get();
      if (!plan && now_ms - asked_ms < PLAN_WAIT_MS) return;
      const timeline = timelineOf(editor.state.get().show, plan);
      if (before_ms === null) preview.begin(timeline);
      else preview.advance(timeline, (now_ms - before_ms) / 1000);
      before_ms = now_ms;
    };
    request = requestAnimationFrame(draw);
    return () => cancelAnimationFrame(request);
  }, [running, preview, editor, full]);
}
