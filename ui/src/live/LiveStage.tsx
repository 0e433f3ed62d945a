import { pathsTo } from '../model/plannedPaths';
import { IconDeviceProjector, IconRoute, IconTarget } from '@tabler/icons-react';
import { useKeys } from '../parts/useKeys';
import { useCallback, useEffect, useMemo, useState } from 'react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { ALWAYS } from '../stage/pans';
import { StageCanvas } from '../stage/StageCanvas';
import { createView } from '../stage/view';
import { fitView, showPlace, StageTool, zoomView, ZoomTools } from '../stage/ViewTools';
import { createCloseWatch } from './closeWatch';
import { openAudience } from './openAudience';
import { createFullPlan } from '../session/fullPlan';
import { RobotTwin } from './RobotTwin';
import { liveScene, wrongIn } from './scene';
import styles from '../stage/stage.module.css';

/** The floor of the live view: robots where they were measured, targets and paths if wanted, and view tools. */
export function LiveStage() {
  const { live, frame, found: search } = useSession();
  const [view] = useState(createView);
  const [full] = useState(() => createFullPlan(live.plan));
  const [close] = useState(createCloseWatch);
  const [targets, setTargets] = useState(true);
  const [routes, setRoutes] = useState(false);
  const show = useStore(live.opened, (o) => o.show);
  const chosen = useStore(frame);
  const playing = useStore(live.playback, (p) => p.frame);
  const plan = useStore(full.plan);
  const found = useStore(live.plan);
  const wrong = useMemo(() => wrongIn(found, chosen), [found, chosen]);
  const empty = useStore(live.fleet, (fleet) => fleet.rows.length === 0);
  const linked = useStore(live.link) === 'open';
  useEffect(() => (routes ? full.follow() : undefined), [routes, full]);
  const searched = useStore(search);
  useEffect(() => {
    const index = live.fleet.get().rows.findIndex(({ id }) => id === searched?.robot);
    const robots = live.track.latest();
    const at = { x: robots?.x[index] ?? NaN, y: robots?.y[index] ?? NaN };
    if (!Number.isNaN(at.x + at.y)) showPlace(view, at);
  }, [searched, live, view]);
  useKeys([
    ['0', () => fitView(view)],
    ['+', () => zoomView(view, 1.4)],
    ['-', () => zoomView(view, 1 / 1.4)],
    ['t', () => setTargets((on) => !on)],
    ['w', () => setRoutes((on) => !on)],
    ['a', openAudience],
  ]);
  const paths = useMemo(
    () => (routes ? pathsTo(plan, show, playing ?? chosen) : []),
    [routes, plan, show, playing, chosen],
  );
  const sceneAt = useCallback(
    (now_ms: number) => liveScene(live, { show, chosen, targets, paths, wrong, close }, now_ms),
    [live, show, chosen, targets, paths, wrong, close],
  );
  return (
    <section className={styles.stage} aria-label="The floor">
      <StageCanvas view={view} sceneAt={sceneAt} pans={ALWAYS} />
      <div className={styles.legend} aria-hidden>
        <span>
          <i /> robot
        </span>
        <span>
          <i data-look="hollow" /> target
        </span>
        <span>
          <i data-look="faded" /> no signal
        </span>
      </div>
      <div className={styles.tools} role="toolbar" aria-label="What the floor shows">
        <StageTool label="Show targets (T)" active={targets} onClick={() => setTargets(!targets)}>
          <IconTarget size={17} />
        </StageTool>
        <StageTool label="Show routes (W)" active={routes} onClick={() => setRoutes(!routes)}>
          <IconRoute size={17} />
        </StageTool>
        <ZoomTools view={view} />
        <StageTool label="Audience view (A)" onClick={openAudience}>
          <IconDeviceProjector size={17} />
        </StageTool>
      </div>
      {linked && empty ? (
        <div className={styles.hint} role="status">
          <strong>No robots yet</strong>
          <br />
          Switch them on, or start
          <br />
          <span className="mono nowrap">lightbots robots --count 30</span>
          <br />
          They appear here by themselves.
        </div>
      ) : null}
      <RobotTwin />
    </section>
  );
}
