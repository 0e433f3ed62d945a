import { useEffect, useState } from 'react';
import { listRuns } from '../api/http';
import type { RunEntry } from '../api/types.gen';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Time until the list is asked for again while its first run has no end yet, milliseconds. */
const AGAIN_MS = 400;
/** Most times that the list is asked for again: the server may write the end of a run a little later. */
const AGAIN_MAX = 25;

/** The recorded runs, asked for whenever the phase becomes `ready`; empty in other phases, and if that fails. */
export function useRuns(): readonly RunEntry[] {
  const { live } = useSession();
  const isReady = useStore(live.playback, (p) => p.phase === 'ready');
  const [runs, setRuns] = useState<readonly RunEntry[]>([]);
  useEffect(() => {
    if (!isReady) return;
    let timer: ReturnType<typeof setTimeout> | undefined;
    let isOver = false;
    const look = async (left: number) => {
      // Without a list, nothing is offered: the dialog of past runs says what is wrong.
      const found = await listRuns().catch(() => []);
      if (isOver) return;
      setRuns(found);
      if (found[0]?.ended_ms === null && left > 0)
        timer = setTimeout(() => void look(left - 1), AGAIN_MS);
    };
    void look(AGAIN_MAX);
    return () => {
      isOver = true;
      clearTimeout(timer);
    };
  }, [isReady]);
  return isReady ? runs : [];
}
