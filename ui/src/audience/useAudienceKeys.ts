import { useEffect } from 'react';
import { turnViewpoint } from './viewpoint';

/** Fills the whole screen, or ends that. Browsers refuse it on some phones; then the window stays as it is. */
export function toggleFullScreen() {
  const isFull = document.fullscreenElement !== null;
  const done = isFull ? document.exitFullscreen() : document.documentElement.requestFullscreen?.();
  done?.catch(() => undefined);
}

/**
 * The keys of the audience view, heard before any other: they would mean something else in the editor behind it. `onSpace`:
 * what Space does; null: nothing. `isOver`: it lies over another page, whose controls must not get the focus.
 */
export function useAudienceKeys(onBack: () => void, onSpace: (() => void) | null, isOver: boolean) {
  useEffect(() => {
    const acts: Readonly<Record<string, () => void>> = {
      p: turnViewpoint,
      f: toggleFullScreen,
      escape: onBack,
      ...(onSpace ? { ' ': onSpace } : {}),
      ...(isOver ? { tab: () => undefined } : {}),
    };
    const receive = (event: KeyboardEvent) => {
      // Shift and Escape stop all robots.
      if (event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
      const act = acts[event.key.toLowerCase()];
      if (!act) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      if (!event.repeat) act();
    };
    window.addEventListener('keydown', receive, { capture: true });
    return () => window.removeEventListener('keydown', receive, { capture: true });
  }, [onBack, onSpace, isOver]);
}
