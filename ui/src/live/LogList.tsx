import { SegmentedControl } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useStorePaced } from '../base/store';
import { useSession } from '../shell/session';
import { shortNames } from './robotWords';

const WORDS = { debug: '', info: '', warn: 'Warning: ', error: 'Error: ' } as const;

/** When thousands of robots come at once, each has a line. */
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
    <ol className="log" aria-label="Log" tabIndex={0}>
      {shown.map((line, i) => (
        <li key={i} data-level={line.level}>
          <time dateTime={new Date(line.time_ms).toISOString()}>
            {new Date(line.time_ms).toTimeString().slice(0, 8)}
          </time>
          <span>
            <b>{WORDS[line.level]}</b>
            {shortNames(line.text)}
          </span>
        </li>
      ))}
      <li ref={end} aria-hidden />
    </ol>
  );
}
