import { Button } from '@mantine/core';
import { IconReportAnalytics } from '@tabler/icons-react';
import { useState } from 'react';
import { RunsDialog } from '../parts/RunsDialog';

/** A button that opens the recorded runs and their reports. */
export function PastRuns() {
  const [shown, setShown] = useState(false);
  return (
    <section aria-label="Past runs">
      <Button
        variant="default"
        leftSection={<IconReportAnalytics size={16} />}
        onClick={() => setShown(true)}
      >
        Past runs and their reports
      </Button>
      {shown ? <RunsDialog onClose={() => setShown(false)} /> : null}
    </section>
  );
}
