import { useEffect } from 'react';
import { useStore } from '../base/store';
import { segmentAt, timelineOf, totalOf, watchFrom } from '../model/timeline';
import type { Editing } from './editing';

/** Without a plan after so long the frames are shown without the drives between them, milliseconds. */
const PATIENCE_MS = 3000;

/** Runs the moment forward while the show is watched without robots. */
export function usePlayback(editing: Editing) {
  const running = useStore(editing.running);
  const looked = useStore(editing.moment, (moment) => moment !== null);
  const { full } = editing;
  useEffect(() => (running || looked ? full.follow() : undefined), [running, looked, full]);
  useEffect(() => {
    if (!running) return;
    const began = performance.now();
    let [request, before] = [0, began];
    let begun = false;
    const step = (now: number) => {
      const plan = editing.full.plan.get();
      if (!plan && now - began < PATIENCE_MS) {
        before = now;
        request = requestAnimationFrame(step);
        return;
      }
      const { show, frame } = editing.editor.state.get();
      const timeline = timelineOf(show, plan);
      const from = begun
        ? (editing.moment.get() ?? 0)
        : watchFrom(timeline, frame, editing.moment.get());
      begun = true;
      const next = from + (now - before) / 1000;
      before = now;
      editing.moment.set(Math.min(next, totalOf(timeline)));
      const at = segmentAt(timeline, next)?.frame;
      if (at !== undefined && at !== editing.editor.state.get().frame) editing.editor.goToFrame(at);
      if (next >= totalOf(timeline)) {
        editing.running.set(false);
        editing.moment.set(null);
      } else request = requestAnimationFrame(step);
    };
    request = requestAnimationFrame(step);
    return () => cancelAnimationFrame(request);
  }, [running, editing]);
}
