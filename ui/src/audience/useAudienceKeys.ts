import { useEffect } from 'react';
import { turnViewpoint } from './viewpoint';

/** Fills the whole screen, or ends that. Browsers refuse it on some phones; then the window stays as it is. */
export function toggleFullScreen() {
  const isFull = document.fullscreenElement !== null;
  const done = isFull ? document.exitFullscreen() : document.documentElement.requestFullscreen?.();
  done?.catch(() => undefined);
}

/**
 * The keys of the audience view, handled before those of a page behind it. `onSpace`: what Space does; null: it is not
 * handled. `isOver`: the view lies over another page, and Tab must not focus that page's controls.
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
      // Shift and Escape together stop all robots, which another handler does.
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
