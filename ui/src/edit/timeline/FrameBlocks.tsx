import { xOf } from '../../model/timelineAxis';
import { isFastest, type Block } from '../../model/timelineBlocks';
import { blockText } from './blockActs';
import { FrameBlock } from './FrameBlock';
import type { TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** Number of neighbouring blocks in one element, so that a drag that moves later blocks moves few elements. */
const GROUP = 12;

interface Props extends Omit<TrackProps, 'show'> {
  /** Index of the frame on the stage. */
  at: number;
  chosen: ReadonlySet<number>;
  /** Indices of frames in which the plan has an error. */
  wrong: ReadonlySet<number | null>;
}

/** The blocks of the frames in sight, and of the frame on the stage. */
export function FrameBlocks({ blocks, axis, drawn, at, chosen, wrong }: Props) {
  const isDrawn = (block: Block, index: number) =>
    // The frame on the stage is there even out of sight, because the list box names it as active.
    index === at ||
    (xOf(axis, block.driveFrom_s) < drawn.to_px && xOf(axis, block.until_s) > drawn.from_px);
  const blockOf = (block: Block, index: number, origin_px: number) => {
    const left = xOf(axis, block.driveFrom_s);
    const travel_s = block.shownFrom_s - block.driveFrom_s;
    return (
      <FrameBlock
        key={block.key}
        id={blockId(block)}
        index={index}
        frame={block.frame}
        left={steady(left - origin_px)}
        width={steady(xOf(axis, block.until_s) - left)}
        travel_px={steady(travel_s * axis.scale)}
        travel_s={steady(travel_s)}
        least_s={block.least_s}
        least_px={(block.least_s ?? 0) * axis.scale}
        isFastest={isFastest(block)}
        isChosen={chosen.has(index)}
        isCurrent={index === at}
        isWrong={wrong.has(index)}
        go={block.go}
        label={blockText(block, index)}
      />
    );
  };
  return groupsOf(blocks).map((group, nth) => {
    const left = xOf(axis, group[0]?.driveFrom_s ?? 0);
    const made = group.flatMap((block, i) => {
      const index = nth * GROUP + i;
      return isDrawn(block, index) ? [blockOf(block, index, left)] : [];
    });
    return made.length === 0 ? null : (
      <div key={nth} role="presentation" className={styles.group} style={{ left }}>
        {made}
      </div>
    );
  });
}

export const blockId = ({ key }: Block) => `timeline-frame-${key}`;

const groupsOf = (blocks: readonly Block[]) =>
  Array.from({ length: Math.ceil(blocks.length / GROUP) }, (_, nth) =>
    blocks.slice(nth * GROUP, (nth + 1) * GROUP),
  );

/** Rounded to a thousandth, so that rounding errors do not draw a block again. */
const steady = (value: number) => Math.round(value * 1e3) / 1e3;
