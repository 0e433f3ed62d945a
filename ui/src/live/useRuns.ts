import { useEffect, useState } from 'react';
import { listRuns } from '../api/http';
import type { RunEntry } from '../api/types.gen';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** The server writes the end of a run to the disk beside the show: the list is asked again this often and this long. */
const AGAIN_MS = 400;
const AGAIN_MAX = 25;

/** The recorded runs while there is no run; asked for anew after each. */
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
