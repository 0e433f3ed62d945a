import type { Live } from '../session/live';
import { EMPTY_STAGE } from '../model/show';
import type { Lights, LightsAt } from './drawing';
import { createEvenMotion } from './evenMotion';

/** The measured lights of robots that are not gone; without a connection those that were measured last. */
export function createLiveLights(live: Pick<Live, 'track' | 'fleet' | 'opened'>): LightsAt {
  const motion = createEvenMotion();
  let taken: ReturnType<Live['track']['latest']> = null;
  let [rows, stage] = [live.fleet.get().rows, live.opened.get().show?.stage ?? EMPTY_STAGE];
  let lights: Lights = { dots: [], floor: stage };
  let wasStill = false;
  // A robot that is gone may be switched off, and what its light does is not known.
  const isShown = (robot: number) => rows[robot]?.presence !== 'gone';
  return (now_ms) => {
    const robots = live.track.latest();
    const [nowRows, nowStage] = [
      live.fleet.get().rows,
      live.opened.get().show?.stage ?? EMPTY_STAGE,
    ];
    if (robots && robots !== taken) motion.push(robots, now_ms);
    const isStill = motion.isStill(now_ms);
    const isSame = wasStill && isStill && nowRows === rows && nowStage === stage;
    [taken, rows, stage, wasStill] = [robots, nowRows, nowStage, isStill];
    if (!isSame) lights = { dots: motion.sample(now_ms, isShown), floor: stage };
    return lights;
  };
}
