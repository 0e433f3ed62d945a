import { getPlan } from '../api/http';
import type { Plan } from '../api/types.gen';
import { createStore, type Readable, type Store } from '../base/store';

/** The plan of the open show with its paths, fetched only between `follow` and the end of the last `follow`. */
export interface FullPlan {
  plan: Store<Plan | null>;
  /** Keeps the plan up to date until the returned function is called. */
  follow(): () => void;
}

/** `brief`: the plan without paths, as the server announces it; null: none. */
export function createFullPlan(brief: Readable<Plan | null>): FullPlan {
  const plan = createStore<Plan | null>(null);
  let followers = 0;
  let stop = () => {};
  const load = () => {
    const announced = brief.get();
    if (!announced) plan.set(null);
    if (!announced || announced.planning) return;
    if (plan.get()?.revision === announced.revision) return;
    getPlan().then(
      (full) => {
        // A plan that is still being made is announced again when it is finished.
        if (!full.planning && brief.get()) plan.set(full);
      },
      () => plan.set(null),
    );
  };
  return {
    plan,
    follow() {
      if (followers++ === 0) stop = brief.subscribe(load);
      load();
      return () => {
        if (--followers === 0) stop();
      };
    },
  };
}
