import { useEffect } from 'react';

/** Keeps the screen from sleeping while `isWanted`, if the browser can: on https or on the server's computer. */
export function useWakeLock(isWanted: boolean) {
  useEffect(() => {
    const { wakeLock } = navigator as { wakeLock?: WakeLock };
    if (!isWanted || !wakeLock) return;
    let lock: WakeLockSentinel | null = null;
    let isOver = false;
    const ask = async () => {
      if (document.hidden) return;
      try {
        const given = await wakeLock.request('screen');
        if (isOver) await given.release();
        else lock = given;
      } catch {
        // Refused, for example because the battery is nearly empty: the screen may sleep.
      }
    };
    // A hidden page loses its lock, and asks again when it is seen.
    document.addEventListener('visibilitychange', ask);
    void ask();
    return () => {
      isOver = true;
      document.removeEventListener('visibilitychange', ask);
      void lock?.release().catch(() => undefined);
    };
  }, [isWanted]);
}
