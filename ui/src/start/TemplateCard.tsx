import { countText } from '../base/numbers';
import { clockText } from '../base/time';
import type { MadeTemplateFrame } from '../make/templateShow';
import type { Template, TemplateFrame } from '../make/templates';
import type { Fleet } from './begin';
import { Picture } from './Picture';
import styles from './Start.module.css';

interface Props {
  template: Template;
  fleet: Fleet;
  /** The frame that the card shows as its picture; null: it is not made yet. */
  face: MadeTemplateFrame | null;
  /** Number of frames made while a show is made of this template; null: none is being made. */
  made: number | null;
  isBusy: boolean;
  onChoose: (frames: readonly TemplateFrame[]) => void;
}

/** A card that begins a show from a template, with a picture for the number of robots of `fleet`. */
export function TemplateCard({ template, fleet, face, made, isBusy, onChoose }: Props) {
  const frames = template.frames(fleet.robots);
  const stays_s = frames.reduce((sum, frame) => sum + frame.airTime_s, 0);
  const error = face?.answer.error ?? null;
  const isHard = face?.answer.readability?.readable === false;
  return (
    <li>
      <button
        type="button"
        className={styles.card}
        disabled={isBusy || error !== null}
        onClick={() => onChoose(frames)}
      >
        <Picture frame={face?.frame ?? null} stage={fleet.stage} />
        <span className={styles.caption}>
          <b>{template.title}</b>
          <span role="status">
            {made !== null
              ? `Making frame ${Math.min(made + 1, frames.length)} of ${frames.length}…`
              : (error?.message ??
                `${countText(frames.length, 'frame')} · shown for ${clockText(stays_s)}`)}
          </span>
          {isHard && made === null ? (
            <span>Hard to read with {countText(fleet.robots, 'robot')}</span>
          ) : null}
        </span>
      </button>
    </li>
  );
}
