import { memo } from 'react';
import styles from './Timeline.module.css';

interface Props {
  id: string;
  index: number;
  title: string;
  label: string;
  /** Distance from the top of the list, CSS pixels. */
  top: number;
  /** Left end of the bar in the lane, CSS pixels; null: there is no bar, because its frames are gone. */
  left: number | null;
  width: number;
  hasEnds: boolean;
  paint: string | undefined;
  isChosen: boolean;
}

/** A layer of light on the timeline. */
export const LayerTrack = memo(function LayerTrack(props: Props) {
  const { title, left, hasEnds } = props;
  return (
    <div
      id={props.id}
      className={styles.layer}
      data-height="layer"
      role="option"
      aria-selected={props.isChosen}
      aria-label={props.label}
      data-layer={props.index}
      style={{ top: props.top }}
    >
      {left === null ? null : (
        <div
          className={styles.bar}
          data-part={hasEnds ? 'whole' : undefined}
          style={{ left, width: props.width }}
        >
          <span>{title}</span>
          <i className={styles.paint} style={{ background: props.paint }} />
          {hasEnds ? (
            <>
              <i className={styles.edge} data-part="from" />
              <i className={styles.edge} data-part="to" />
            </>
          ) : null}
        </div>
      )}
    </div>
  );
});
