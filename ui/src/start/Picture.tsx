import { useMemo } from 'react';
import type { Frame, Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';
import styles from './Start.module.css';

/** Side of the picture, in extents of the lights: the rest is room around them. */
const ROOM = 1.25;

/** A picture of a frame, zoomed in on its lights; empty without a frame. */
export function Picture({ frame, stage }: { frame: Frame | null; stage: Stage }) {
  const near = useMemo(() => {
    if (!frame) return stage;
    // The lights are around the middle of the floor.
    const reach_m = Math.max(0.1, ...frame.pixels.flatMap((p) => [Math.abs(p.x), Math.abs(p.y)]));
    const side_m = Math.min(2 * reach_m * ROOM, Math.max(stage.width_m, stage.depth_m));
    return { ...stage, width_m: side_m, depth_m: side_m };
  }, [frame, stage]);
  return (
    <span className={styles.picture}>
      {frame ? <Thumbnail frame={frame} stage={near} /> : null}
    </span>
  );
}
