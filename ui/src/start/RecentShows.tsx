import { Title } from '@mantine/core';
import { useEffect, useState } from 'react';
import { getState, listShows } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import { countText } from '../base/numbers';
import { openShow } from '../session/openShow';
import { useSession } from '../session/session';
import { goTo } from '../session/address';
import { ShowThumbnail } from '../parts/ShowThumbnail';
import styles from './Start.module.css';

/** Most shows that are listed. */
const LISTED = 4;

/** The shows that were saved last, then shows that were not saved here, such as examples; nothing without a list. */
export function RecentShows() {
  const session = useSession();
  const [entries, setEntries] = useState<readonly ShowEntry[]>([]);
  useEffect(() => {
    // If that fails, the section stays away: the library dialog says what is wrong.
    listShows().then(
      (found) => setEntries([...found].sort((a, b) => latest(b) - latest(a)).slice(0, LISTED)),
      () => undefined,
    );
  }, []);
  if (entries.length === 0) return null;
  const open = async (name: string) => {
    if (await openShow(session, name)) goTo('edit');
  };
  return (
    <section aria-labelledby="recent">
      <Title order={2} size="h4" id="recent">
        Recent shows
      </Title>
      <ul className={styles.recent}>
        {entries.map((entry) => (
          <li key={entry.name}>
            <button type="button" onClick={() => void open(entry.name)}>
              <ShowThumbnail
                version={`${entry.name} ${entry.etag}`}
                load={() => getState(entry.name, null)}
              />
              <span>
                <b>{entry.name}</b>
                <span>
                  {countText(entry.frames, 'frame')} · {countText(entry.pixels, 'robot')}
                </span>
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

const latest = (entry: ShowEntry) => (entry.origin === 'saved' ? entry.modified_ms : 0);
