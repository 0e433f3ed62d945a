import { type Obstacle, type Point, boxBetween } from '../base/geometry';
import { setStage } from './commands';
import type { Show } from './show';

/** Most no-go areas of a document. */
const OBSTACLES_MAX = 1000;
/** Least side of a drawn rectangle, or radius of a disc, metres; a smaller drag draws nothing. */
const SIDE_MIN = 0.01;

const withObstacles = (show: Show, obstacles: readonly Obstacle[]) => setStage(show, { obstacles });

export const addObstacle = (show: Show, obstacle: Obstacle): Show =>
  show.stage.obstacles.length >= OBSTACLES_MAX
    ? show
    : withObstacles(show, [...show.stage.obstacles, obstacle]);

export const removeObstacle = (show: Show, index: number): Show =>
  index in show.stage.obstacles
    ? withObstacles(
        show,
        show.stage.obstacles.filter((_, i) => i !== index),
      )
    : show;

export const setObstacle = (show: Show, index: number, obstacle: Obstacle): Show =>
  withObstacles(
    show,
    show.stage.obstacles.map((o, i) => (i === index ? obstacle : o)),
  );

/** The rectangle between two corners, or with `round` the disc from its centre; `null` if it is too small. */
export function obstacleBetween(a: Point, b: Point, round: boolean): Obstacle | null {
  const box = boxBetween(a, b);
  if (round) {
    const radius_m = Math.hypot(b.x - a.x, b.y - a.y);
    return radius_m < SIDE_MIN ? null : { kind: 'disc', x: a.x, y: a.y, radius_m };
  }
  const thin = Math.min(box.maxX - box.minX, box.maxY - box.minY) < SIDE_MIN;
  return thin ? null : { kind: 'rect', ...box };
}

/** Index of the last obstacle at a place, which is drawn on top; −1: none. */
export const obstacleAt = (obstacles: readonly Obstacle[], p: Point): number =>
  obstacles.findLastIndex((o) =>
    o.kind === 'disc'
      ? Math.hypot(p.x - o.x, p.y - o.y) <= o.radius_m
      : p.x >= o.minX && p.x <= o.maxX && p.y >= o.minY && p.y <= o.maxY,
  );

export const shiftObstacle = (o: Obstacle, dx: number, dy: number): Obstacle =>
  o.kind === 'disc'
    ? { ...o, x: o.x + dx, y: o.y + dy }
    : { ...o, minX: o.minX + dx, maxX: o.maxX + dx, minY: o.minY + dy, maxY: o.maxY + dy };
