import { SegmentedControl } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useStorePaced } from '../base/store';
import type { LogLine } from '../api/types.gen';
import { useSession } from '../session/session';
import { shortId, shortNames } from '../session/robotWords';
import styles from './LogList.module.css';

const WORDS = { debug: '', info: '', warn: 'Warning: ', error: 'Error: ' } as const;

/** Lines may come one upon the other. */
const EVERY_MS = 100;

/** What happened, newest at the end; nothing is done for it while nobody looks. */
export function LogList({ seen }: { seen: boolean }) {
  const [only, setOnly] = useState('all');
  return (
    <>
      <SegmentedControl
        size="xs"
        m="xs"
        aria-label="What the log shows"
        value={only}
        onChange={setOnly}
        data={[
          { value: 'all', label: 'Events' },
          { value: 'problems', label: 'Problems' },
          { value: 'debug', label: 'Everything' },
        ]}
      />
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

/** Whom a line is about that sums up several robots; the names are there only while somebody wants to see them. */
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
