import type { Fleet, Plan } from '../api/types.gen';
import { unitStore } from '../session/preferences';
import { paintPins } from '../stage/pinMark';
import { contact_m, EMPTY_STAGE, type Show } from '../model/show';
import { hollowOf } from '../model/dots';
import { floorOf, type Scene } from '../stage/scene';
import { paintClose, type CloseWatch } from './closeWatch';
import { paintCallouts } from './incidentMark';
import { calloutsOf } from '../session/incidents';
import type { Live } from '../session/live';
import { isRunning } from '../session/phases';

const ALPHAS = { active: 1, stale: 0.4, gone: 0.15 } as const;
const fades = new WeakMap<Fleet, (robot: number) => number>();

/** Opacity, 0 to 1, by index in the fleet table: silent robots are faded. The same function for the same table. */
export function fade(fleet: Fleet): (robot: number) => number {
  let faded = fades.get(fleet);
  if (!faded) {
    const alphas = fleet.rows.map((row) => ALPHAS[row.presence]);
    faded = (robot) => alphas[robot] ?? 1;
    fades.set(fleet, faded);
  }
  return faded;
}

const NOTHING: readonly never[] = [];
export interface LiveSceneInputs {
  show: Show | null;
  /** Index of the frame chosen in the strip. */
  chosen: number;
  targets: boolean;
  paths: Scene['paths'];
  /** Ids of the chosen frame's pixels that errors of the plan name. */
  wrong: ReadonlySet<number>;
  close: CloseWatch;
}

/** Ids of the pixels that the plan's errors about a frame name; empty without a plan. */
export const wrongIn = (plan: Plan | null, frame: number): ReadonlySet<number> =>
  new Set(
    plan?.issues
      .filter((issue) => issue.severity === 'error' && issue.frame === frame)
      .flatMap((issue) => issue.pixels),
  );

/** The scene of the live stage: targets are those of the run while one is on, else the pixels of the chosen frame. */
export function liveScene(live: Live, inputs: LiveSceneInputs, now_ms: number): Scene {
  const sample = live.track.sample(now_ms, fade(live.fleet.get()));
  const running = isRunning(live.playback.get().phase);
  const stage = inputs.show?.stage ?? EMPTY_STAGE;
  const hollow = running ? sample.hollow : hollowOf(inputs.show?.frames[inputs.chosen]);
  const pinned = inputs.show?.frames[inputs.chosen]?.pixels.filter((p) => p.robot !== null) ?? [];
  const wrong =
    inputs.show?.frames[inputs.chosen]?.pixels.filter((p) => inputs.wrong.has(p.id)) ?? NOTHING;
  const callouts = calloutsOf(live.incidents.get(), live.fleet.get(), live.track.latest());
  const close = inputs.close.find(sample.filled, contact_m(stage), now_ms);
  return {
    ...floorOf(stage, unitStore.get()),
    filled: sample.filled,
    hollow: inputs.targets ? hollow : NOTHING,
    errors: inputs.targets && running ? sample.errors : NOTHING,
    paths: inputs.paths,
    overlay: (context, camera) => {
      if (inputs.targets && !running) {
        paintPins(context, camera, stage.radius_m, pinned);
        paintClose(context, camera, stage.radius_m, wrong);
      }
      paintClose(
        context,
        camera,
        stage.radius_m,
        close.flatMap((i) => sample.filled[i] ?? []),
      );
      paintCallouts(context, camera, stage.radius_m, callouts);
    },
  };
}
