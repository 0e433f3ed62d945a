import type { Plan } from '../api/types.gen';

/** A plan for tests: it is ok, without drives and issues. `planning`: it is still being made. */
export const planOf = (revision: number, planning = false): Plan => ({
  revision,
  planning,
  ok: true,
  duration_s: 1,
  lower_bound_s: 1,
  closest_m: 0.1,
  stop_safe: 1,
  plan_ms: 1,
  issues: [],
  transitions: [],
});
