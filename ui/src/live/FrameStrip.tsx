import { useEffect, useRef } from 'react';
import { useStore } from '../base/store';
import { goOf } from '../model/cues';
import type { Show } from '../model/show';
import { GoMark } from '../parts/GoMark';
import { useSession } from '../session/session';
import { Thumbnail } from '../stage/Thumbnail';
import { isRunning } from '../session/phases';
import styles from '../parts/strip.module.css';

/** The frames in playing order: choose the one to play from, see the one that plays. */
export function FrameStrip() {
  const { live, frame } = useSession();
  const show = useStore(live.opened, (o) => o.show);
  const chosen = useStore(frame);
  const playing = useStore(live.playback, (p) => (isRunning(p.phase) ? p.frame : null));
  const list = useRef<HTMLUListElement>(null);
  const seen = playing ?? chosen;
  useEffect(() => {
    list.current?.children[seen]?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [seen]);
  useEffect(() => {
    if (show && chosen >= show.frames.length) frame.set(Math.max(0, show.frames.length - 1));
  }, [show, chosen, frame]);
  if (!show || show.frames.length === 0)
    return (
      <p className="quiet" style={{ padding: '8px 14px 16px', margin: 0 }}>
        No show is open. Open one above, or drop a file anywhere.
      </p>
    );
  return (
    <ul className={styles.strip} ref={list} aria-label="Frames">
      {show.frames.map((f, i) => (
        <li key={f.key}>
          <button
            type="button"
            className={styles.card}
            aria-current={i === chosen}
            data-playing={i === playing}
            onClick={() => frame.set(i)}
            title={f.name}
          >
            <Thumbnail frame={f} stage={show.stage} />
            <span className={styles.label}>
              <b>{i + 1}</b>
              <span>{f.name}</span>
              <Mark show={show} index={i} />
            </span>
          </button>
        </li>
      ))}
    </ul>
  );
}

function Mark({ show, index }: { show: Show; index: number }) {
  const go = goOf(show, index);
  return go === null ? null : <GoMark go={go} />;
}
