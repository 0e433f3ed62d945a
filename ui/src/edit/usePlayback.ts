import { useEffect } from 'react';
import { useStore } from '../base/store';
import { segmentAt, timelineOf, totalOf } from '../model/timeline';
import type { Editing } from './editing';

/** Runs the moment forward while the show is watched without robots. */
export function usePlayback(editing: Editing) {
  const running = useStore(editing.running);
  const looked = useStore(editing.moment, (moment) => moment !== null);
  const { full } = editing;
  useEffect(() => (running || looked ? full.follow() : undefined), [running, looked, full]);
  useEffect(() => {
    if (!running) return;
    let [request, before] = [0, performance.now()];
    const step = (now: number) => {
      const { show } = editing.editor.state.get();
      const timeline = timelineOf(show, editing.full.plan.get());
      const next = (editing.moment.get() ?? 0) + (now - before) / 1000;
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
