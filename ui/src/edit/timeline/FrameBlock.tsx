import { IconPin } from '@tabler/icons-react';
import { memo } from 'react';
import { secondsText, shortSeconds } from '../../base/time';
import type { Frame } from '../../model/show';
import { framePaint } from './paint';
import styles from './Timeline.module.css';

interface Props {
  id: string;
  index: number;
  frame: Frame;
  /** Left end within its group, CSS pixels, as are all fields with `_px` and `width`. */
  left: number;
  width: number;
  travel_px: number;
  travel_s: number;
  /** Shortest travel time, seconds; null: the drive is not planned. */
  least_s: number | null;
  least_px: number;
  isFastest: boolean;
  isChosen: boolean;
  isCurrent: boolean;
  /** Whether the plan has an error in this frame. */
  isWrong: boolean;
  go: 'waits' | 'repeats' | null;
  label: string;
}

/** Least width of a block with texts, with its number, and with edges to drag, CSS pixels. */
const [TEXT_PX, NUMBER_PX, EDGE_PX] = [44, 24, 14];
/** Least widths of a drive for its longer and its shorter text, CSS pixels. */
const [LONG_PX, SHORT_PX] = [104, 40];

/** The travel time as text that fits the drive's width; empty without a plan or room. */
function travelText({ travel_s, least_s, travel_px, isFastest }: Props): string {
  if (least_s === null || travel_px < SHORT_PX) return '';
  if (travel_px < LONG_PX) return secondsText(travel_s);
  const least = isFastest ? 'least' : `least ${secondsText(least_s)}`;
  return `${secondsText(travel_s)} · ${least}`;
}

/** A frame on the timeline: first the drive to it, hatched, then its air time in the colours of its pixels. */
export const FrameBlock = memo(function FrameBlock(props: Props) {
  const { left, width } = props;
  return (
    <div
      id={props.id}
      className={styles.block}
      role="option"
      aria-selected={props.isChosen}
      // Also the name for screen readers: what is in the block is hidden from them.
      title={props.label}
      data-frame={props.index}
      data-current={props.isCurrent || undefined}
      data-wrong={props.isWrong || undefined}
      style={{ left, width: Math.max(1, width - 1) }}
    >
      <Inside {...props} left={0} />
    </div>
  );
});

/** What is in a block. A component of its own, so that a block that only moves does not render it again. */
const Inside = memo(function Inside(props: Props) {
  const { index, frame, width, travel_px, go } = props;
  const isRoomy = width >= TEXT_PX;
  const travel = travelText(props);
  return (
    <>
      {width >= NUMBER_PX ? (
        <span className={styles.title} aria-hidden>
          <b>
            {index + 1}
            {props.isWrong ? ' !' : ''}
          </b>
          {isRoomy && frame.at_s !== null ? <IconPin size={11} /> : null}
          {isRoomy ? <span>{frame.name}</span> : null}
        </span>
      ) : null}
      <span className={styles.travel} style={{ width: travel_px }} aria-hidden>
        {isRoomy && travel ? <span>{travel}</span> : null}
      </span>
      {props.least_s !== null && travel_px > 4 ? (
        <i
          className={styles.least}
          data-reached={props.isFastest || undefined}
          style={{ left: props.least_px }}
        />
      ) : null}
      <span
        className={styles.air}
        aria-hidden
        style={{ left: travel_px, background: framePaint(frame.pixels) }}
      >
        {width - travel_px >= TEXT_PX ? <span>{shortSeconds(frame.airTime_s)} s</span> : null}
      </span>
      {go || (isRoomy && props.isChosen) ? (
        <em
          className={styles.cue}
          aria-hidden
          data-cue
          data-on={go ?? undefined}
          title={cueTip(go)}
        >
          {isRoomy ? 'GO' : ''}
        </em>
      ) : null}
      {width >= EDGE_PX ? (
        <>
          <i className={styles.edge} data-edge="travel" style={{ left: travel_px }} />
          <i className={styles.edge} data-edge="air" />
        </>
      ) : null}
    </>
  );
});

const cueTip = (go: Props['go']) =>
  go === null ? 'Wait for GO after this frame' : 'Go on by itself after this frame';
