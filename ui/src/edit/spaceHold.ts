import { createStore, type Readable } from '../base/store';
import type { Pans } from '../stage/pans';

/** The space key: a drag while it is held moves the view; without a drag, letting it go does something else. */
export interface SpaceHold extends Pans {
  held: Readable<boolean>;
  /** The key went down. */
  press(): void;
}

/** `alsoPans`: whether a drag pans without the key; `tap`: called when the key is let go and nothing was dragged. */
export function createSpaceHold(alsoPans: () => boolean, tap: () => void): SpaceHold {
  const held = createStore(false);
  let hasPanned = false;
  let end = () => {};
  return {
    held,
    press() {
      end();
      hasPanned = false;
      held.set(true);
      const stop = new AbortController();
      end = () => {
        stop.abort();
        held.set(false);
      };
      const up = (event: KeyboardEvent) => {
        if (event.key !== ' ') return;
        end();
        if (!hasPanned) tap();
      };
      window.addEventListener('keyup', up, { signal: stop.signal });
      // This window will not hear that the key is let go.
      window.addEventListener('blur', () => end(), { signal: stop.signal });
    },
    wanted: () => held.get() || alsoPans(),
    began() {
      hasPanned = true;
    },
  };
}
