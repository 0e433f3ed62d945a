import { IconBulb, IconRoute } from '@tabler/icons-react';
import { memo, type MouseEvent } from 'react';
import type { Frame, Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';
import { GoMark } from '../parts/GoMark';
import { NameField } from './NameField';
import strip from '../parts/strip.module.css';
import styles from './FrameCard.module.css';

interface Props {
  frame: Frame;
  index: number;
  stage: Stage;
  current: boolean;
  chosen: boolean;
  /** Travel time to the frame, seconds, as text; empty while it is not planned. */
  drive: string;
  /** What the show does after the frame until GO; null: it goes on by itself. */
  go: 'waits' | 'repeats' | null;
  /** Whether the plan has an error in this frame. */
  wrong: boolean;
  onChoose: (event: MouseEvent) => void;
  /** Whether the frame is being renamed. */
  naming: boolean;
  /** The typed name; `null`: cancelled. */
  onName: (name: string | null) => void;
  onRename: () => void;
  onDragStart: () => void;
  onDragEnd: () => void;
}

/** One frame of the strip. */
export const FrameCard = memo(function FrameCard(props: Props) {
  const { frame, index } = props;
  if (props.naming)
    return (
      <div className={strip.card} data-chosen>
        <Thumbnail frame={frame} stage={props.stage} />
        <NameField label="Name of the frame" name={frame.name} onName={props.onName} />
      </div>
    );
  return (
    <button
      type="button"
      className={strip.card}
      draggable
      aria-current={props.current}
      data-chosen={props.chosen || undefined}
      data-wrong={props.wrong || undefined}
      onClick={props.onChoose}
      onDoubleClick={props.onRename}
      onDragStart={(event) => {
        event.dataTransfer.effectAllowed = 'move';
        event.dataTransfer.setData('text/plain', frame.name);
        props.onDragStart();
      }}
      onDragEnd={props.onDragEnd}
      title={`${frame.name}: drive there ${props.drive ? `${props.drive} s` : 'not planned yet'}, shown for ${frame.airTime_s} s. Double click: rename`}
    >
      <Thumbnail frame={frame} stage={props.stage} />
      <span className={strip.label}>
        <b>
          {index + 1}
          {props.wrong ? ' !' : ''}
        </b>
        <span>{frame.name}</span>
        {props.go === null ? null : <GoMark go={props.go} />}
      </span>
      <span className={styles.times}>
        {props.drive ? (
          <span>
            <IconRoute size={11} aria-hidden />
            <span className="hidden-text">drive, seconds: </span>
            {props.drive}
          </span>
        ) : null}
        <span>
          <IconBulb size={11} aria-hidden />
          <span className="hidden-text"> shown for </span>
          {frame.airTime_s} s
        </span>
      </span>
    </button>
  );
});
