import { memo, type MouseEvent } from 'react';
import type { Frame, Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';

interface Props {
  frame: Frame;
  index: number;
  stage: Stage;
  current: boolean;
  chosen: boolean;
  /** Drive and air time, for people. */
  times: string;
  /** Whether it cannot be played as it is. */
  wrong: boolean;
  onChoose: (event: MouseEvent) => void;
  onDragStart: () => void;
  onDragEnd: () => void;
}

/** One frame of the strip. */
export const FrameCard = memo(function FrameCard(props: Props) {
  const { frame, index } = props;
  return (
    <button
      type="button"
      className="card"
      draggable
      aria-current={props.current}
      data-chosen={props.chosen || undefined}
      data-wrong={props.wrong || undefined}
      onClick={props.onChoose}
      onDragStart={(event) => {
        event.dataTransfer.effectAllowed = 'move';
        event.dataTransfer.setData('text/plain', frame.name);
        props.onDragStart();
      }}
      onDragEnd={props.onDragEnd}
      title={`${frame.name}: drive + air time ${props.times}`}
    >
      <Thumbnail frame={frame} stage={props.stage} />
      <span className="label">
        <b>
          {index + 1}
          {props.wrong ? ' !' : ''}
        </b>
        <span>{frame.name}</span>
      </span>
      <span className="times">{props.times}</span>
    </button>
  );
});
