import type { Point } from '../base/geometry';
import { crowded } from '../model/marks';
import { canvasFromStage, type Camera } from '../stage/camera';
import { FLOOR } from '../stage/palette';

/** Looked for this often, milliseconds: among thousands it takes a while. */
const EVERY_MS = 200;

/** Finds robots that are drawn so close that their rims touch. */
export interface CloseWatch {
  /** Which of the places are closer to another than `gap_m`; looked for anew a few times a second. */
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

/** Dashed rings around those that touch, as in the editor. */
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
