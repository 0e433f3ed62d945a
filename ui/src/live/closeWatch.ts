import type { Point } from '../base/geometry';
import { crowded } from '../model/marks';
import { canvasFromStage, type Camera } from '../stage/camera';
import { FLOOR } from '../stage/palette';

/** Period of the search, milliseconds, because it takes long with thousands of robots. */
const EVERY_MS = 200;

/** Finds places, stage metres, that are closer to another one than a gap. */
export interface CloseWatch {
  /** Indices of the places closer than `gap_m` to another; up to `EVERY_MS` old while their number stays the same. */
  find(places: readonly Point[], gap_m: number, now_ms: number): readonly number[];
}

export function createCloseWatch(): CloseWatch {
  let [found, looked_ms, count] = [[] as readonly number[], -Infinity, 0];
  return {
    find(places, gap_m, now_ms) {
      if (now_ms - looked_ms < EVERY_MS && count === places.length) return found;
      [looked_ms, count] = [now_ms, places.length];
      const close = crowded(
        places.map((p, id) => ({ id, x: p.x, y: p.y })),
        gap_m,
      );
      found = [...close];
      return found;
    },
  };
}

/** Draws dashed rings around positions, stage metres; `radius_m`: of a robot. */
export function paintClose(
  c: CanvasRenderingContext2D,
  camera: Camera,
  radius_m: number,
  at: readonly Point[],
) {
  if (at.length === 0) return;
  const radius = Math.max(3, radius_m * camera.scale) + 6.5;
  c.setLineDash([3, 2.5]);
  c.strokeStyle = FLOOR.care;
  c.lineWidth = 1.75;
  c.beginPath();
  for (const place of at) {
    const { x, y } = canvasFromStage(camera, place);
    c.moveTo(x + radius, y);
    c.arc(x, y, radius, 0, 2 * Math.PI);
  }
  c.stroke();
  c.setLineDash([]);
}
