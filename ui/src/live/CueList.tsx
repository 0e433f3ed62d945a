import { Button } from '@mantine/core';
import { useEffect, useRef } from 'react';
import { useStore } from '../base/store';
import { secondsText } from '../base/time';
import { Gate } from '../parts/Gate';
import { useSession } from '../session/session';
import { cueRows, frameText, isPlayed, wayOn, whyNoJump, type CueRow } from './cueRows';
import styles from './CueList.module.css';

/** What plays now, what is next in large type, and all frames with what ends each of them. */
export function CueList() {
  const { live, frame } = useSession();
  const show = useStore(live.opened, (o) => o.show);
  const phase = useStore(live.playback, (p) => p.phase);
  const now = useStore(live.playback, (p) => p.frame);
  const next = useStore(live.playback, (p) => p.next);
  const mayJump = useStore(live.playback, (p) => p.may_jump);
  const linked = useStore(live.link) === 'open';
  const chosen = useStore(frame);
  if (!show || show.frames.length === 0)
    return (
      <p className={`quiet ${styles.empty}`}>No show is open. Open one to see its frames here.</p>
    );
  const rows = cueRows(show, { phase, frame: now, next }, chosen);
  const why = whyNoJump({ phase, may_jump: mayJump }, linked);
  const plays = isPlayed(phase);
  return (
    <Gate needs="operator" act="go to a frame">
      <dl className={styles.head} data-testid="cue-head">
        <dt>Now</dt>
        <dd>{frameText(show.frames, plays ? now : null)}</dd>
        <dt>Next</dt>
        <dd className={styles.next}>
          <strong>{headNext(rows, show.frames, plays)}</strong>
          {plays ? <SkipButton next={next} disabled={why !== null} /> : null}
        </dd>
      </dl>
      {why === null || !plays ? null : <p className={`quiet ${styles.why}`}>{why}</p>}
      <ol className={styles.list} aria-label="Cues">
        {rows.map((row) => (
          <Row key={row.key} row={row} isChosen={row.index === chosen} why={why} />
        ))}
      </ol>
    </Gate>
  );
}

function headNext(
  rows: readonly CueRow[],
  frames: Parameters<typeof frameText>[0],
  plays: boolean,
) {
  const next = rows.find((row) => row.place === 'next');
  if (next) return frameText(frames, next.index);
  return plays ? 'The show ends' : '–';
}

function SkipButton({ next, disabled }: { next: number | null; disabled: boolean }) {
  const { ask } = useSession();
  if (next === null) return null;
  return (
    <Button
      size="compact-sm"
      variant="default"
      disabled={disabled}
      onClick={() => void ask({ do: 'skip' })}
    >
      Skip frame {next + 1} (N)
    </Button>
  );
}

function Row({ row, isChosen, why }: { row: CueRow; isChosen: boolean; why: string | null }) {
  const { frame, jumpAsked } = useSession();
  const { index, name, air_s, place } = row;
  const element = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (place === 'now') element.current?.scrollIntoView({ block: 'nearest' });
  }, [place]);
  return (
    <li
      ref={element}
      className={styles.row}
      data-place={place ?? undefined}
      aria-current={place === 'now' ? 'step' : undefined}
    >
      <button
        type="button"
        className={styles.frame}
        aria-pressed={isChosen}
        onClick={() => frame.set(index)}
      >
        <span>
          <b>{index + 1}</b> {name}
          {place === null ? null : (
            <em className={styles.mark}>{place === 'now' ? 'Now' : 'Next'}</em>
          )}
        </span>
        <span className="quiet">
          {secondsText(air_s)}, {wayOn(row)}
        </span>
      </button>
      <Button
        size="compact-sm"
        variant="default"
        aria-label={`Go to frame ${index + 1}`}
        disabled={why !== null}
        title={why ?? undefined}
        onClick={() => jumpAsked.set(index)}
      >
        Go to
      </Button>
    </li>
  );
}
