import { getPlan } from '../api/http';
import type { Plan, Transition } from '../api/types.gen';
import { createStore, type Store } from '../base/store';
import { polyline } from '../model/path';
import type { Pixel, Show } from '../model/show';
import type { Point } from '../stage/camera';
import type { Scene } from '../stage/scene';
import type { Live } from './store';

/** The plan of the open show with its paths, fetched when somebody wants to see them. */
export interface FullPlan {
  plan: Store<Plan | null>;
  /** Fetches as long as it is wanted; returns how to stop. */
  follow(): () => void;
}

export function createFullPlan(live: Live): FullPlan {
  const plan = createStore<Plan | null>(null);
  let followers = 0;
  const load = () => {
    const brief = live.plan.get();
    if (followers === 0 || !brief || brief.planning) return;
    if (plan.get()?.revision === brief.revision) return;
    getPlan().then(
      (full) => {
        // One that is still being made is announced again when it is there.
        if (!full.planning) plan.set(full);
      },
      () => plan.set(null),
    );
  };
  live.plan.subscribe(load);
  return {
    plan,
    follow() {
      followers++;
      load();
      return () => {
        followers--;
      };
    },
  };
}

let drawn: { transition?: Transition; pixels?: readonly Pixel[]; paths: Scene['paths'] } = {
  paths: [],
};

/** The ways to frame `to`, in the colours they end in; the same list as long as they stay. */
export function pathsTo(plan: Plan | null, show: Show | null, to: number): Scene['paths'] {
  const transition = plan?.transitions.find((t) => t.to === to);
  const pixels = show?.frames[to]?.pixels;
  if (drawn.transition !== transition || drawn.pixels !== pixels)
    drawn = { transition, pixels, paths: transition ? waysOf(transition, pixels ?? []) : [] };
  return drawn.paths;
}

const lines = new WeakMap<Transition, readonly (readonly Point[])[]>();

function linesOf(transition: Transition) {
  const known = lines.get(transition) ?? transition.paths.map(polyline);
  lines.set(transition, known);
  return known;
}

function waysOf(transition: Transition, pixels: readonly Pixel[]): Scene['paths'] {
  const colors = new Map(pixels.map((p) => [p.id, p.color]));
  return linesOf(transition).map((points, robot) => ({
    points,
    color: colors.get(transition.pixels[robot] ?? -1) ?? 0,
  }));
}
