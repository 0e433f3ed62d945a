import { canvasFromStage, type Camera } from '../stage/camera';
import { FLOOR } from '../stage/palette';
import type { Callout } from '../session/incidents';

const FONT = '600 13px Inter, system-ui, sans-serif';
/** Padding of a label at its left and right, its distance from the ring, and its height, CSS pixels. */
const [PAD_PX, OFF_PX, HIGH_PX] = [7, 8, 22];

/** Draws a ring around each callout, and a label at its right, or at its left near the canvas's right edge. */
export function paintCallouts(
  c: CanvasRenderingContext2D,
  camera: Camera,
  radius_m: number,
  callouts: readonly Callout[],
) {
  if (callouts.length === 0) return;
  const ring_px = Math.max(4, radius_m * camera.scale) + 8;
  const width_px = c.canvas.width / c.getTransform().a;
  c.save();
  c.font = FONT;
  c.textBaseline = 'middle';
  for (const callout of callouts) {
    const { x, y } = canvasFromStage(camera, callout);
    c.strokeStyle = FLOOR.care;
    c.lineWidth = 2.5;
    c.beginPath();
    c.arc(x, y, ring_px, 0, 2 * Math.PI);
    c.stroke();
    const text = `Robot ${callout.name}`;
    const wide_px = c.measureText(text).width + 2 * PAD_PX;
    const right = x + ring_px + OFF_PX;
    const left = right + wide_px > width_px ? x - ring_px - OFF_PX - wide_px : right;
    c.fillStyle = FLOOR.floor;
    c.beginPath();
    c.roundRect(left, y - HIGH_PX / 2, wide_px, HIGH_PX, 6);
    c.fill();
    c.lineWidth = 1.5;
    c.stroke();
    c.fillStyle = FLOOR.ink;
    c.fillText(text, left + PAD_PX, y + 0.5);
  }
  c.restore();
}
