import { Button, Tooltip } from '@mantine/core';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { useSession } from '../session/session';
import { phaseText } from './actions';
import styles from './PlayState.module.css';

/** The state of the show in words, robots that are late, slow speeds, and the time left. */
export function PlayState() {
  const { live, frame, waiting } = useSession();
  const isWaiting = useStore(waiting, (pending) => pending !== null);
  const from = useStore(frame);
  // Texts, not the object, because an equal text does not render this again with each message.
  const phase = useStore(live.playback, (p) => p.phase);
  const text = useStore(live.playback, phaseText);
  const failed = useStore(live.playback, (p) => p.phase === 'ready' && p.failure !== null);
  const left = useStore(live.playback, (p) => (p.left_s === null ? null : clockText(p.left_s)));
  const late = useStore(live.playback, (p) => p.late.join(' '));
  const drives = useStore(live.playback, (p) => p.doing === 'driving' || p.doing === 'holding');
  const speed = useStore(live.playback, (p) => p.speed_percent);
  const pace = useStore(live.pace, (share) => Math.round(share * 100));
  const rows = live.fleet.get().rows;
  const names = (late ? late.split(' ') : []).map((id) => {
    const pixel = rows.find((row) => row.id === id)?.pixel;
    return pixel === null || pixel === undefined ? id.slice(0, 8) : `pixel ${pixel}`;
  });
  return (
    <div className={styles.state}>
      <span role="status" data-testid="phase" data-phase={phase} data-failed={failed || undefined}>
        {isWaiting ? 'Starts when planning is done' : text}
      </span>
      {phase === 'ready' && from > 0 ? (
        <span className="quiet">
          from frame {from + 1}{' '}
          <Button
            size="compact-xs"
            variant="subtle"
            color="gray"
            onClick={() => frame.set(0)}
            aria-label="Play from the first frame instead"
          >
            from 1
          </Button>
        </span>
      ) : null}
      {names.length > 0 ? (
        <Tooltip label={`${drives ? 'On the way' : 'Waiting for'}: ${names.join(', ')}`}>
          <span className="quiet">
            {names.length === 20 ? '20+' : names.length} {drives ? 'on the way' : 'awaited'}
          </span>
        </Tooltip>
      ) : null}
      {speed < 100 ? <span className={styles.slow}>drives at {speed} %</span> : null}
      {pace < 100 ? <SlowTime percent={pace} /> : null}
      {left === null ? null : (
        <span className="quiet">
          −{left}
          <span className="hidden-text"> left</span>
        </span>
      )}
    </div>
  );
}

/** Shows that the server simulates the robots slower than real time. */
function SlowTime({ percent }: { percent: number }) {
  return (
    <Tooltip
      multiline
      w={260}
      label={`The computer of the server cannot simulate so many robots in real time. They and the show go at ${percent} % of their speed instead; nothing is lost.`}
    >
      <span className={styles.slow} tabIndex={0} data-testid="pace">
        simulation at {percent} % speed
      </span>
    </Tooltip>
  );
}
