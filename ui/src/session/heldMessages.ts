import type { ToScreen } from '../api/types.gen';

/** Messages of which a page shows the newest alone: to draw the others costs time, and a hidden page draws nothing. */
const NEWEST_COUNTS = ['fleet', 'state'] as const;
type Held = Extract<ToScreen, { type: (typeof NEWEST_COUNTS)[number] }>;

const isHeld = (message: ToScreen): message is Held =>
  NEWEST_COUNTS.some((type) => type === message.type);

/** Holds back what a hidden page need not show. */
export interface HeldMessages {
  /** Whether the message is held back. */
  hold(message: ToScreen): boolean;
  /** The messages that were held back, to be shown now. */
  release(): ToScreen[];
}

export function createHeldMessages(isHidden: () => boolean): HeldMessages {
  const newest = new Map<Held['type'], Held>();
  return {
    hold(message) {
      if (!isHeld(message)) return false;
      newest.delete(message.type);
      if (!isHidden()) return false;
      newest.set(message.type, message);
      return true;
    },
    release() {
      const all = [...newest.values()];
      newest.clear();
      return all;
    },
  };
}
