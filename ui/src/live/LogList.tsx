import { SegmentedControl } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useStore } from '../base/store';
import { useSession } from '../shell/session';
import { shortNames } from './robotWords';

const WORDS = { debug: '', info: '', warn: 'Warning: ', error: 'Error: ' } as const;

/** What happened, newest at the end. */
export function LogList() {
  const { live } = useSession();
  const lines = useStore(live.log);
  const [only, setOnly] = useState('all');
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
    </>
  );
}
