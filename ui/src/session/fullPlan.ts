import { getPlan } from '../api/http';
import type { Plan } from '../api/types.gen';
import { createStore, type Store } from '../base/store';
import type { Live } from './live';

/** The plan of the open show with its paths, fetched only while a component shows the paths. */
export interface FullPlan {
  plan: Store<Plan | null>;
  /** Keeps the plan up to date until the returned function is called. */
  follow(): () => void;
}

export function createFullPlan(live: Live): FullPlan {
  const plan = createStore<Plan | null>(null);
  let followers = 0;
  let stop = () => {};
  const load = () => {
    const brief = live.plan.get();
    if (!brief || brief.planning) return;
    if (plan.get()?.revision === brief.revision) return;
    getPlan().then(
      (full) => {
        // A plan that is still being made is announced again when it is finished.
        if (!full.planning) plan.set(full);
      },
      () => plan.set(null),
    );
  };
  return {
    plan,
    follow() {
      if (followers++ === 0) stop = live.plan.subscribe(load);
      load();
      return () => {
        if (--followers === 0) stop();
      };
    },
  };
}
