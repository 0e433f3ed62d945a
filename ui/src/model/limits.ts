import { setStage } from './commands';
import type { Show, Stage } from './show';

/** Size and limits of a show's robots: radius, m; speed, m/s; acceleration, m/s²; turn rate, rad/s. */
export type LimitName = 'radius_m' | 'speed_mps' | 'accel_mps2' | 'turn_radps';

/** The Elisa-3's values, for a show that does not say its own. */
export const LIMITS_USUAL: Readonly<Record<LimitName, number>> = {
  radius_m: 0.027,
  speed_mps: 0.27,
  accel_mps2: 1,
  turn_radps: 4.5,
};

const written = (stage: Stage): Readonly<Record<string, unknown>> =>
  typeof stage.rest.robot === 'object' ? (stage.rest.robot as Record<string, unknown>) : {};

export function limitOf(stage: Stage, name: LimitName): number {
  const value = written(stage)[name];
  return typeof value === 'number' ? value : LIMITS_USUAL[name];
}

export function setLimit(show: Show, name: LimitName, value: number): Show {
  if (limitOf(show.stage, name) === value) return show;
  const rest = { ...show.stage.rest, robot: { ...written(show.stage), [name]: value } };
  return setStage(show, name === 'radius_m' ? { radius_m: value, rest } : { rest });
}
