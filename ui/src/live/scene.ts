import type { Fleet, Phase, Plan } from '../api/types.gen';
import { unitStore } from '../session/preferences';
import { paintPins } from '../stage/pinMark';
import { contact_m, EMPTY_STAGE, type Show } from '../model/show';
import { hollowOf } from '../model/dots';
import { floorOf, type Scene } from '../stage/scene';
import { paintClose, type CloseWatch } from './closeWatch';
import type { Live } from '../session/live';

const ALPHAS = { active: 1, stale: 0.4, gone: 0.15 } as const;
const fades = new WeakMap<Fleet, (robot: number) => number>();

/** How strongly a robot is drawn: silent ones faded. */
export function fade(fleet: Fleet): (robot: number) => number {
  let faded = fades.get(fleet);
  if (!faded) {
    const alphas = fleet.rows.map((row) => ALPHAS[row.presence]);
    faded = (robot) => alphas[robot] ?? 1;
    fades.set(fleet, faded);
  }
  return faded;
}

/** Whether robots are on their way, so that their goals are what is planned. */
export const isRunning = (phase: Phase) => phase !== 'idle' && phase !== 'ready';

const NOTHING: readonly never[] = [];
export interface SceneWish {
  show: Show | null;
  /** The frame chosen in the strip. */
  chosen: number;
  targets: boolean;
  paths: Scene['paths'];
  /** Ids of the pixels of the chosen frame that the plan finds wrong. */
  wrong: ReadonlySet<number>;
  close: CloseWatch;
}

/** Ids of the pixels of a frame that errors of the plan are about: too close, in the way, or out of reach. */
export const wrongIn = (plan: Plan | null, frame: number): ReadonlySet<number> =>
  new Set(
    plan?.issues
      .filter((issue) => issue.severity === 'error' && issue.frame === frame)
      .flatMap((issue) => issue.pixels),
  );

/** What the live stage shows now. */
export function liveScene(live: Live, wish: SceneWish, now_ms: number): Scene {
  const sample = live.track.sample(now_ms, fade(live.fleet.get()));
  const running = isRunning(live.playback.get().phase);
  const stage = wish.show?.stage ?? EMPTY_STAGE;
  const hollow = running ? sample.hollow : hollowOf(wish.show?.frames[wish.chosen]);
  const pinned = wish.show?.frames[wish.chosen]?.pixels.filter((p) => p.robot !== null) ?? [];
  const wrong =
    wish.show?.frames[wish.chosen]?.pixels.filter((p) => wish.wrong.has(p.id)) ?? NOTHING;
  const close = wish.close.find(sample.filled, contact_m(stage), now_ms);
  return {
    ...floorOf(stage, unitStore.get()),
    filled: sample.filled,
    hollow: wish.targets ? hollow : NOTHING,
    errors: wish.targets && running ? sample.errors : NOTHING,
    paths: wish.paths,
    overlay: (context, camera) => {
      if (wish.targets && !running) {
        paintPins(context, camera, stage.radius_m, pinned);
        paintClose(context, camera, stage.radius_m, wrong);
      }
      paintClose(
        context,
        camera,
        stage.radius_m,
        close.flatMap((i) => sample.filled[i] ?? []),
      );
    },
  };
}
