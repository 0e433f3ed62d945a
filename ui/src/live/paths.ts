import { getPlan } from '../api/http';
import type { Plan } from '../api/types.gen';
import { createStore, type Store } from '../base/store';
import { polyline } from '../model/path';
import type { Show } from '../model/show';
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
      (full) => plan.set(full),
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

/** The ways to frame `to`, in the colours they end in. */
export function pathsTo(plan: Plan | null, show: Show | null, to: number): Scene['paths'] {
  const transition = plan?.transitions.find((t) => t.to === to);
  if (!transition) return [];
  const colors = new Map(show?.frames[to]?.pixels.map((p) => [p.id, p.color]));
  return transition.paths.map((path, robot) => ({
    points: polyline(path),
    color: colors.get(transition.pixels[robot] ?? -1) ?? 0,
  }));
}
