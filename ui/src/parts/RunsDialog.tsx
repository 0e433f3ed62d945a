import { Modal, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { listRuns } from '../api/http';
import type { RunEntry } from '../api/types.gen';
import { useStore } from '../base/store';
import { attempt } from '../session/libraryActs';
import { runOutcome, runTimes, runTitle } from '../session/runs';
import { useSession } from '../session/session';
import { ReportButtons } from './ReportButtons';
import styles from './RunsDialog.module.css';

/** A dialog with the recorded runs: how each ended, and its report if it has one. */
export function RunsDialog({ onClose }: { onClose: () => void }) {
  const { live } = useSession();
  const isIdle = useStore(live.playback, (p) => p.phase === 'ready' || p.phase === 'idle');
  const [runs, setRuns] = useState<readonly RunEntry[]>();
  useEffect(() => {
    void attempt(() => listRuns().then(setRuns));
  }, [isIdle]);
  return (
    <Modal opened onClose={onClose} title="Past runs" size="lg">
      <ul className={styles.list} aria-label="Past runs">
        {runs?.map((run, place) => (
          <Run key={run.number} run={run} isOn={place === 0 && !isIdle} />
        ))}
      </ul>
      <Text c="dimmed" size="xs" mt="md">
        {runs?.length === 0
          ? 'Nothing was played yet. Each run is recorded, and listed here.'
          : 'The last 20 runs are kept. A report is one file that needs no other: send it or keep it.'}
      </Text>
    </Modal>
  );
}

function Run({ run, isOn }: { run: RunEntry; isOn: boolean }) {
  return (
    <li>
      <span>
        <b>{runTitle(run)}</b>
        <span className="quiet">
          Run {run.number} · {runTimes(run)}
        </span>
        <span data-tone={run.ok || isOn ? undefined : 'look'}>{runOutcome(run, isOn)}</span>
      </span>
      {isOn ? null : run.has_report ? (
        <ReportButtons run={run} named />
      ) : (
        <span className="quiet">Recorded by another version: no report</span>
      )}
    </li>
  );
}
