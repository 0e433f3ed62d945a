import { Button, CloseButton } from '@mantine/core';
import { IconReportAnalytics } from '@tabler/icons-react';
import { useStore } from '../base/store';
import { ReportButtons } from '../parts/ReportButtons';
import { dismissedRun, offeredRun, runOutcome } from '../session/runs';
import { useSession } from '../session/session';
import { useRuns } from './useRuns';
import styles from './Note.module.css';

/** After a show has ended, offers its report, until that is dismissed on this screen or another show begins. */
export function RunNote({ onPast }: { onPast: () => void }) {
  const { live } = useSession();
  const runs = useRuns();
  const dismissed = useStore(dismissedRun);
  // After a failure or a stop, another note already says how the show ended.
  const isTold = useStore(live.playback, (p) => p.failure !== null || p.stopped_in !== null);
  const run = offeredRun(runs, dismissed);
  if (run === null) return null;
  return (
    <div className={styles.note} data-tone="done" data-testid="run-note">
      <IconReportAnalytics size={20} aria-hidden />
      <strong>{isTold ? 'The report of this run is ready.' : runOutcome(run, false)}</strong>
      <ReportButtons run={run} />
      <Button size="compact-sm" variant="subtle" color="gray" onClick={onPast}>
        Past runs
      </Button>
      <CloseButton
        aria-label="Dismiss the report"
        onClick={() => dismissedRun.set(String(run.began_ms))}
      />
    </div>
  );
}
