import type { ToScreen } from '../api/types.gen';

/** Messages of which a page shows the newest alone: to draw the others costs time, and a hidden page draws nothing. */
const NEWEST_COUNTS = ['fleet', 'state'] as const;
type Held = Extract<ToScreen, { type: (typeof NEWEST_COUNTS)[number] }>;

const isHeld = (message: ToScreen): message is Held =>
  NEWEST_COUNTS.some((type) => type === message.type);

/** A hidden page is brought up to date this often, milliseconds: its text and its name stay near the truth. */
const SHOWN_EVERY_MS = 10_000;

/** Holds back what a hidden page need not show. */
export interface HeldMessages {
  /** Whether the message is held back. */
  hold(message: ToScreen, now_ms: number): boolean;
  /** The messages that were held back, to be shown now. */
  release(): ToScreen[];
}

export function createHeldMessages(isHidden: () => boolean): HeldMessages {
  const newest = new Map<Held['type'], Held>();
  const shown_ms = new Map<Held['type'], number>();
  return {
    hold(message, now_ms) {
      if (!isHeld(message)) return false;
      const { type } = message;
      newest.delete(type);
      const isDue = now_ms - (shown_ms.get(type) ?? -Infinity) >= SHOWN_EVERY_MS;
      if (!isHidden() || isDue) {
        shown_ms.set(type, now_ms);
        return false;
      }
      newest.set(type, message);
      return true;
    },
    release() {
      const all = [...newest.values()];
      newest.clear();
      return all;
    },
  };
}
