import { xOf } from '../../model/timelineAxis';
import { isFastest, type Block } from '../../model/timelineBlocks';
import { blockText } from './blockActs';
import { FrameBlock } from './FrameBlock';
import type { TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** Blocks beside each other that hang on one element: a drag moves all later blocks alike. */
const GROUP = 12;

interface Props extends Omit<TrackProps, 'show'> {
  /** The frame on the stage. */
  at: number;
  chosen: ReadonlySet<number>;
  /** Frames in which the plan has an error. */
  wrong: ReadonlySet<number | null>;
}

/** The blocks of the frames that are in sight. */
export function FrameBlocks({ blocks, axis, drawn, at, chosen, wrong }: Props) {
  const isDrawn = (block: Block, index: number) =>
    // The chosen one is there also when it is out of sight: the list says which it is.
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

/** The same number for differences that were computed in other ways, so that nothing is drawn for rounding. */
const steady = (value: number) => Math.round(value * 1e3) / 1e3;
