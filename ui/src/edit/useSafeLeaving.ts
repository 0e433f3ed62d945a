import { useEffect } from 'react';
import type { Editing } from './editing';

/** Writes the draft when the page goes, and asks before it goes with changes there was no room for. */
export function useSafeLeaving(editing: Editing | null) {
  useEffect(() => {
    if (!editing) return;
    const { keeper, saver } = editing;
    const leave = () => {
      keeper.flush();
      saver.flush();
    };
    const ask = (event: BeforeUnloadEvent) => {
      keeper.flush();
      if (keeper.isEndangered()) event.preventDefault();
    };
    const hide = () => {
      if (document.visibilityState === 'hidden') leave();
    };
    window.addEventListener('pagehide', leave);
    window.addEventListener('beforeunload', ask);
    document.addEventListener('visibilitychange', hide);
    return () => {
      leave();
      window.removeEventListener('pagehide', leave);
      window.removeEventListener('beforeunload', ask);
      document.removeEventListener('visibilitychange', hide);
    };
  }, [editing]);
}
