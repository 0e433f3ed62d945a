import { Button, Group, SegmentedControl } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useStorePaced } from '../base/store';
import type { LogLine } from '../api/types.gen';
import { useSession } from '../session/session';
import { shortId, shortNames } from '../session/robotWords';
import styles from './LogList.module.css';

const WORDS = { debug: '', info: '', warn: 'Warning: ', error: 'Error: ' } as const;

/** Least time between two renderings, milliseconds, because many lines may arrive at once. */
const EVERY_MS = 100;

interface Props {
  /** Whether the tab of the log is in front; if not, its lines are not rendered. */
  seen: boolean;
  /** Opens the dialog of past runs. */
  onPast: () => void;
}

/** The log, newest line last. */
export function LogList({ seen, onPast }: Props) {
  const [only, setOnly] = useState('all');
  return (
    <>
      <Group m="xs" gap="xs" justify="space-between">
        <SegmentedControl
          size="xs"
          aria-label="What the log shows"
          value={only}
          onChange={setOnly}
          data={[
            { value: 'all', label: 'Activity' },
            { value: 'problems', label: 'Problems' },
            { value: 'debug', label: 'Debug' },
          ]}
        />
        <Button size="compact-sm" variant="subtle" color="gray" onClick={onPast}>
          Past runs
        </Button>
      </Group>
      {seen ? <Lines only={only} /> : null}
    </>
  );
}

function Lines({ only }: { only: string }) {
  const { live } = useSession();
  const lines = useStorePaced(live.log, EVERY_MS);
  const end = useRef<HTMLLIElement>(null);
  useEffect(() => {
    end.current?.scrollIntoView({ block: 'nearest' });
  }, [lines, only]);
  const shown = lines.filter((line) =>
    only === 'all'
      ? line.level !== 'debug'
      : only === 'debug' || line.level === 'warn' || line.level === 'error',
  );
  return (
    <ol className={styles.log} aria-label="Log" tabIndex={0}>
      {shown.map((line) => (
        <li key={line.id} data-level={line.level}>
          <time dateTime={new Date(line.time_ms).toISOString()}>
            {new Date(line.time_ms).toTimeString().slice(0, 8)}
          </time>
          <span>
            <b>{WORDS[line.level]}</b>
            {shortNames(line.text)}
            {line.count > 0 ? <Names line={line} /> : null}
          </span>
        </li>
      ))}
      <li ref={end} aria-hidden />
    </ol>
  );
}

/** The robots that a summarising line is about, by short ids; they are in the page only while the list is open. */
function Names({ line: { robots, count } }: { line: LogLine }) {
  const [open, setOpen] = useState(false);
  const more = count - robots.length;
  return (
    <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>Which</summary>
      {open ? robots.map(shortId).join(', ') + (more > 0 ? ` and ${more} more` : '') : null}
    </details>
  );
}
