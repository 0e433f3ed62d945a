import { Button } from '@mantine/core';
import type { RunEntry } from '../api/types.gen';
import { reportLinks, runTitle } from '../session/runs';

/** Buttons that open a run's report in a new tab and save it as a file. `named`: screen readers hear of which run. */
export function ReportButtons({ run, named }: { run: RunEntry; named?: boolean }) {
  const { read, save } = reportLinks(run);
  const name = (verb: string) =>
    named ? `${verb} the report of run ${run.number}, ${runTitle(run)}` : undefined;
  return (
    <>
      <Button component="a" {...read} size="compact-sm" aria-label={name('Read')}>
        Read the report
      </Button>
      <Button
        component="a"
        {...save}
        size="compact-sm"
        variant="default"
        aria-label={name('Download')}
      >
        Download
      </Button>
    </>
  );
}
