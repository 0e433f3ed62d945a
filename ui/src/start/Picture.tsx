import { useMemo } from 'react';
import type { Frame, Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';
import styles from './Start.module.css';

/** Room around the lights, as a share of their extent. */
const ROOM = 1.25;

/** A frame as large as its place on the screen allows; empty while there is none. */
export function Picture({ frame, stage }: { frame: Frame | null; stage: Stage }) {
  const near = useMemo(() => {
    if (!frame) return stage;
    // Pictures of the engine stand in the middle of the floor.
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
