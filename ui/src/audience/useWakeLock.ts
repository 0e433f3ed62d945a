import { useEffect } from 'react';

/** Keeps the screen from sleeping while it is wanted, where the browser can: on https and on the server's own computer. */
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
        // Such as a battery that is nearly empty: the screen may sleep.
      }
    };
    // A hidden page loses its lock.
    document.addEventListener('visibilitychange', ask);
    void ask();
    return () => {
      isOver = true;
      document.removeEventListener('visibilitychange', ask);
      void lock?.release().catch(() => undefined);
    };
  }, [isWanted]);
}
