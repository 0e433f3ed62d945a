import type { ToScreen } from '../api/types.gen';

/** Types of messages of which only the newest counts. A hidden page draws nothing, so most of them can wait. */
const NEWEST_COUNTS = ['fleet', 'state'] as const;
type Held = Extract<ToScreen, { type: (typeof NEWEST_COUNTS)[number] }>;

const isHeld = (message: ToScreen): message is Held =>
  NEWEST_COUNTS.some((type) => type === message.type);

/** A hidden page still shows one message of each such type this often, milliseconds: text and title stay true. */
const SHOWN_EVERY_MS = 10_000;

/** Holds back what a hidden page need not show. */
export interface HeldMessages {
  /** Takes a message; answers whether it is held back. A message that is not must be shown now. */
  hold(message: ToScreen, now_ms: number): boolean;
  /** Hands out the messages held back, at most one of each type, and forgets them. */
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
