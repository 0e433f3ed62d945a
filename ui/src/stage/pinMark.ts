import type { Point } from '../base/geometry';
import { canvasFromStage, type Camera } from './camera';
import { FLOOR } from './palette';

/** Draws a pin at the upper right of each pixel at `at`, stage metres. `r_m`: radius of a robot, metres. */
export function paintPins(c: CanvasRenderingContext2D, camera: Camera, r_m: number, at: Point[]) {
  const radius = Math.max(3, r_m * camera.scale) * 0.75;
  c.strokeStyle = FLOOR.ink;
  c.fillStyle = FLOOR.pin;
  c.lineWidth = 1.5;
  for (const place of at) {
    const { x, y } = canvasFromStage(camera, place);
    const [fromX, fromY] = [x + radius, y - radius];
    c.beginPath();
    c.moveTo(fromX, fromY);
    c.lineTo(fromX + 6, fromY - 6);
    c.stroke();
    c.beginPath();
    c.arc(fromX + 7.5, fromY - 7.5, 3.5, 0, 2 * Math.PI);
    c.fill();
  }
}
