import { toHex } from '../base/colour';
import { canvasFromStage, gridStep, type Camera } from './camera';
import type { Dot, Scene } from './scene';
import { createSprites } from './sprites';

/** Draws scenes. Canvas2D is the only one there is; another (WebGL) would stand behind the same two calls. */
export interface StageRenderer {
  resize(width_px: number, height_px: number, density: number): void;
  draw(scene: Scene, camera: Camera): void;
}

const FLOOR = '#0a0c11';
const FLOOR_EDGE = '#2b3342';
const GRID = 'rgba(148,163,190,0.075)';
const AXIS = 'rgba(148,163,190,0.17)';
const RULER = '#7d889c';

export function createCanvas2d(element: HTMLCanvasElement): StageRenderer {
  const context = element.getContext('2d', { alpha: false });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const sprites = createSprites();
  let [width, height, density] = [0, 0, 1];

  const drawFilled = (dots: readonly Dot[], scene: Scene, camera: Camera) => {
    const radius = Math.max(1.2, scene.radius_m * camera.scale);
    const body = sprites.body(radius * density);
    const bodyHalf = body.width / 2;
    context.globalCompositeOperation = 'source-over';
    for (const dot of dots) {
      context.globalAlpha = 0.35 + 0.65 * dot.alpha;
      const [x, y] = place(dot, camera, density);
      context.drawImage(body, x - bodyHalf, y - bodyHalf);
    }
    context.globalCompositeOperation = 'lighter';
    for (const dot of dots) {
      const glow = sprites.glow(dot.color, radius * density);
      if (!glow) continue;
      context.globalAlpha = dot.alpha;
      const [x, y] = place(dot, camera, density);
      context.drawImage(glow, x - glow.width / 2, y - glow.height / 2);
    }
    context.globalCompositeOperation = 'source-over';
    context.globalAlpha = 1;
  };

  return {
    resize(width_px, height_px, nextDensity) {
      [width, height, density] = [width_px, height_px, nextDensity];
      element.width = Math.max(1, Math.round(width * density));
      element.height = Math.max(1, Math.round(height * density));
    },
    draw(scene, camera) {
      context.setTransform(density, 0, 0, density, 0, 0);
      drawFloor(context, scene, camera, width, height);
      drawPaths(context, scene, camera);
      drawHollow(context, scene, camera);
      context.setTransform(1, 0, 0, 1, 0, 0);
      drawFilled(scene.filled, scene, camera);
      context.setTransform(density, 0, 0, density, 0, 0);
      drawErrors(context, scene, camera);
      scene.overlay?.(context, camera);
    },
  };
}

/** Device pixels of a dot. */
function place(dot: Dot, camera: Camera, density: number): [number, number] {
  return [
    (camera.originX_px + dot.x * camera.scale) * density,
    (camera.originY_px - dot.y * camera.scale) * density,
  ];
}

function drawFloor(
  context: CanvasRenderingContext2D,
  scene: Scene,
  camera: Camera,
  width: number,
  height: number,
) {
  context.fillStyle = '#06070a';
  context.fillRect(0, 0, width, height);
  const min = canvasFromStage(camera, { x: -scene.width_m / 2, y: scene.depth_m / 2 });
  const [w, h] = [scene.width_m * camera.scale, scene.depth_m * camera.scale];
  context.fillStyle = FLOOR;
  context.fillRect(min.x, min.y, w, h);
  if (scene.grid) drawGrid(context, scene, camera);
  context.fillStyle = 'rgba(120,134,160,0.16)';
  context.strokeStyle = '#59637a';
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
  context.strokeStyle = FLOOR_EDGE;
  context.lineWidth = 1.5;
  context.strokeRect(min.x, min.y, w, h);
}

function drawGrid(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  const step = gridStep(camera.scale);
  const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  const [halfW, halfD] = [scene.width_m / 2, scene.depth_m / 2];
  const line = (ax: number, ay: number, bx: number, by: number, strong: boolean) => {
    const a = canvasFromStage(camera, { x: ax, y: ay });
    const b = canvasFromStage(camera, { x: bx, y: by });
    context.strokeStyle = strong ? AXIS : GRID;
    context.beginPath();
    context.moveTo(Math.round(a.x) + 0.5, Math.round(a.y) + 0.5);
    context.lineTo(Math.round(b.x) + 0.5, Math.round(b.y) + 0.5);
    context.stroke();
  };
  context.lineWidth = 1;
  context.font = '11px system-ui, sans-serif';
  context.fillStyle = RULER;
  context.textBaseline = 'top';
  context.textAlign = 'center';
  for (let k = Math.ceil(-halfW / step); k * step <= halfW + 1e-9; k++) {
    line(k * step, -halfD, k * step, halfD, k === 0);
    const at = canvasFromStage(camera, { x: k * step, y: -halfD });
    context.fillText((k * step).toFixed(digits), at.x, at.y + 7);
  }
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  for (let k = Math.ceil(-halfD / step); k * step <= halfD + 1e-9; k++) {
    line(-halfW, k * step, halfW, k * step, k === 0);
    const at = canvasFromStage(camera, { x: -halfW, y: k * step });
    context.fillText((k * step).toFixed(digits), at.x - 8, at.y);
  }
}

function drawPaths(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  context.lineWidth = 1.25;
  context.globalAlpha = 0.5;
  for (const path of scene.paths) {
    context.strokeStyle = path.color === 0 ? '#59637a' : toHex(path.color);
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

function drawHollow(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  const radius = Math.max(2, scene.radius_m * camera.scale);
  context.lineWidth = Math.max(1, Math.min(2, radius * 0.16));
  for (const dot of scene.hollow) {
    const at = canvasFromStage(camera, dot);
    context.globalAlpha = 0.7 * dot.alpha;
    context.strokeStyle = dot.color === 0 ? '#7d889c' : toHex(dot.color);
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.stroke();
  }
  context.globalAlpha = 1;
}

function drawErrors(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  context.strokeStyle = 'rgba(255,255,255,0.5)';
  context.lineWidth = 1;
  context.setLineDash([3, 3]);
  context.beginPath();
  for (const [from, to] of scene.errors) {
    const [a, b] = [canvasFromStage(camera, from), canvasFromStage(camera, to)];
    context.moveTo(a.x, a.y);
    context.lineTo(b.x, b.y);
  }
  context.stroke();
  context.setLineDash([]);
}
