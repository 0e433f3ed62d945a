import { useMemo, useState } from 'react';
import type { MadeTemplateFrame } from '../make/templateShow';
import type { Stage } from '../model/show';
import { unitStore } from '../session/preferences';
import { NEVER } from '../stage/pans';
import { floorOf, type Scene } from '../stage/scene';
import { StageCanvas } from '../stage/StageCanvas';
import { createView } from '../stage/view';
import styles from './Start.module.css';

interface Props {
  made: MadeTemplateFrame | null;
  stage: Stage;
  /** The fleet in a few words. */
  about: string;
}

/** The floor with the pixels that were made of the words; empty until then. */
export function WordFloor({ made, stage, about }: Props) {
  const [view] = useState(createView);
  const sceneAt = useMemo(() => sceneOf(made, stage), [made, stage]);
  return (
    <div className={styles.floor}>
      <StageCanvas view={view} sceneAt={sceneAt} pans={NEVER} />
      <span className={styles.about}>{about}</span>
    </div>
  );
}

/** A function that gives one and the same scene. */
function sceneOf(made: MadeTemplateFrame | null, stage: Stage): () => Scene {
  const pixels = made?.frame.pixels ?? [];
  const scene: Scene = {
    ...floorOf(stage, unitStore.get()),
    grid: false,
    filled: pixels.map(({ x, y, color }) => ({ x, y, color, alpha: 1 })),
    hollow: [],
    errors: [],
    paths: [],
  };
  return () => scene;
}
