import { toHex } from '../base/colour';
import { UNITS } from '../base/units';
import { canvasFromStage, gridStep, type Camera, type Size } from './camera';
import type { Scene } from './scene';
import { FLOOR } from './palette';

/** Draws floor and obstacles, and with `scene.grid` grid and rulers, over a canvas of `size` in CSS pixels. */
export function drawFloor(
  context: CanvasRenderingContext2D,
  scene: Scene,
  camera: Camera,
  size: Size,
) {
  context.fillStyle = FLOOR.floor;
  context.fillRect(0, 0, size.width_px, size.height_px);
  const min = canvasFromStage(camera, { x: -scene.width_m / 2, y: scene.depth_m / 2 });
  const [w, h] = [scene.width_m * camera.scale, scene.depth_m * camera.scale];
  context.fillStyle = FLOOR.plate;
  context.fillRect(min.x, min.y, w, h);
  if (scene.grid) drawGrid(context, scene, camera);
  context.fillStyle = FLOOR.obstacle;
  context.strokeStyle = FLOOR.rim;
  context.lineWidth = 1;
  for (const o of scene.obstacles) {
    context.beginPath();
    if (o.kind === 'disc') {
      const at = canvasFromStage(camera, o);
      context.arc(at.x, at.y, o.radius_m * camera.scale, 0, 2 * Math.PI);
    } else {
      const at = canvasFromStage(camera, { x: o.minX, y: o.maxY });
      context.rect(at.x, at.y, (o.maxX - o.minX) * camera.scale, (o.maxY - o.minY) * camera.scale);
    }
    context.fill();
    context.stroke();
  }
  context.strokeStyle = FLOOR.edge;
  context.lineWidth = 1.5;
  context.strokeRect(min.x, min.y, w, h);
}

/** Font size of the rulers, CSS pixels: 11 at a page font size of 16, growing with it. */
const rulerSize_px = () =>
  Math.round(11 * (parseFloat(getComputedStyle(document.documentElement).fontSize) / 16));

function drawGrid(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  const unit = scene.unit ?? 'm';
  const { metres } = UNITS[unit];
  const step_units = gridStep(camera.scale * metres);
  const step = step_units * metres;
  const digits = Math.max(0, Math.ceil(-Math.log10(step_units) - 1e-9));
  const [halfW, halfD] = [scene.width_m / 2, scene.depth_m / 2];
  const line = (ax: number, ay: number, bx: number, by: number, strong: boolean) => {
    const a = canvasFromStage(camera, { x: ax, y: ay });
    const b = canvasFromStage(camera, { x: bx, y: by });
    context.strokeStyle = strong ? FLOOR.axis : FLOOR.grid;
    context.beginPath();
    context.moveTo(Math.round(a.x) + 0.5, Math.round(a.y) + 0.5);
    context.lineTo(Math.round(b.x) + 0.5, Math.round(b.y) + 0.5);
    context.stroke();
  };
  context.lineWidth = 1;
  context.font = `${rulerSize_px()}px system-ui, sans-serif`;
  context.fillStyle = FLOOR.ink2;
  context.textBaseline = 'top';
  context.textAlign = 'center';
  for (let k = Math.ceil(-halfW / step); k * step <= halfW + 1e-9; k++) {
    line(k * step, -halfD, k * step, halfD, k === 0);
    const at = canvasFromStage(camera, { x: k * step, y: -halfD });
    context.fillText((k * step_units).toFixed(digits), at.x, at.y + 7);
  }
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  for (let k = Math.ceil(-halfD / step); k * step <= halfD + 1e-9; k++) {
    line(-halfW, k * step, halfW, k * step, k === 0);
    const at = canvasFromStage(camera, { x: -halfW, y: k * step });
    context.fillText((k * step_units).toFixed(digits), at.x - 8, at.y);
  }
  const corner = canvasFromStage(camera, { x: halfW, y: -halfD });
  context.textAlign = 'left';
  context.fillText(unit, corner.x + 6, corner.y);
}

/** Draws the planned paths, each in its colour; black ones in grey. */
export function drawPaths(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  context.lineWidth = 1.25;
  context.globalAlpha = 0.5;
  for (const path of scene.paths) {
    context.strokeStyle = path.color === 0 ? FLOOR.rim : toHex(path.color);
    context.beginPath();
    path.points.forEach((p, i) => {
      const at = canvasFromStage(camera, p);
      if (i === 0) context.moveTo(at.x, at.y);
      else context.lineTo(at.x, at.y);
    });
    context.stroke();
  }
  context.globalAlpha = 1;
}
