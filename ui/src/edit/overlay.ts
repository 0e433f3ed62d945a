import type { EditorState } from '../model/editorState';
import { type Point, boxOf } from '../base/geometry';
import { canvasFromStage, type Camera } from '../stage/camera';
import { marksOf, type Marks } from '../model/marks';
import type { Frame, Stage } from '../model/show';
import { createSprites } from '../stage/sprites';
import type { Handle } from '../model/transformTool';
import { paintPins } from '../stage/pinMark';
import type { StageOptions } from './editing';
import { FLOOR } from '../stage/palette';

/** Distance of the box of handles from the selected pixels, CSS pixels. */
const HANDLE_GAP_PX = 16;
/** A press nearer than this to a handle takes it, CSS pixels. */
const HANDLE_REACH_PX = 11;

/** Handles of the box around the selection, CSS pixels; none for fewer than two pixels. */
function handlesOf(state: EditorState, camera: Camera): { handle: Handle; at: Point }[] {
  const pixels =
    state.show.frames[state.frame]?.pixels.filter((p) => state.selection.has(p.id)) ?? [];
  if (pixels.length < 2) return [];
  const box = boxOf(pixels);
  const a = canvasFromStage(camera, { x: box.minX, y: box.maxY });
  const b = canvasFromStage(camera, { x: box.maxX, y: box.minY });
  const gap = HANDLE_GAP_PX;
  const [left, top, right, bottom] = [a.x - gap, a.y - gap, b.x + gap, b.y + gap];
  const [midX, midY] = [(left + right) / 2, (top + bottom) / 2];
  const scale = (sx: -1 | 0 | 1, sy: -1 | 0 | 1) => ({
    handle: { kind: 'scale', sx, sy } as const,
    at: { x: sx < 0 ? left : sx > 0 ? right : midX, y: sy > 0 ? top : sy < 0 ? bottom : midY },
  });
  return [
    { handle: { kind: 'turn' }, at: { x: midX, y: top - 26 } },
    ...(
      [
        [-1, 1],
        [1, 1],
        [1, -1],
        [-1, -1],
        [0, 1],
        [1, 0],
        [0, -1],
        [-1, 0],
      ] as const
    ).map(([sx, sy]) => scale(sx, sy)),
  ];
}

/** The handle nearer to a pointer than `HANDLE_REACH_PX` or `reach_px`, whichever is larger; null: none. */
export const handleAt = (state: EditorState, camera: Camera, at: Point, reach_px: number) =>
  handlesOf(state, camera).find(
    (h) => Math.hypot(h.at.x - at.x, h.at.y - at.y) < Math.max(HANDLE_REACH_PX, reach_px),
  )?.handle ?? null;

const NO_MARKS: Marks = { tooClose: new Set(), offFloor: new Set() };
let markedFor: { frame: Frame; stage: Stage } | null = null;
let marks = NO_MARKS;

/** Marks of the frame on the stage, worked out again only when the frame or the floor is another object. */
export function marksNow(state: EditorState): Marks {
  const frame = state.show.frames[state.frame];
  const { stage } = state.show;
  if (!frame) return NO_MARKS;
  if (frame !== markedFor?.frame || stage !== markedFor.stage) {
    markedFor = { frame, stage };
    marks = marksOf(frame.pixels, stage);
  }
  return marks;
}

const sprites = createSprites();

/** Draws over the lights: selection and its handles, wrong pixels, pins, ids if wanted, and the current gesture. */
export function paintOverlay(
  context: CanvasRenderingContext2D,
  camera: Camera,
  state: EditorState,
  options: StageOptions,
) {
  const radius = Math.max(3, state.show.stage.radius_m * camera.scale);
  const { tooClose, offFloor } = marksNow(state);
  const density = context.getTransform().a;
  // Rings around small lights stay close to them: they would cover the colours of the neighbours.
  const gap = Math.min(3, 0.5 * radius);
  const sizes = [Math.min(1.75, 0.3 * radius), radius + gap, radius + 2.2 * gap];
  const [line_px, chosen_px, close_px] = sizes.map((px) => px * density);
  const chosen = sprites.ring(FLOOR.chosen, chosen_px ?? 0, line_px ?? 0);
  const close = sprites.ring(FLOOR.care, close_px ?? 0, line_px ?? 0, true);
  for (const p of state.show.frames[state.frame]?.pixels ?? []) {
    const at = canvasFromStage(camera, p);
    if (state.selection.has(p.id)) stamp(context, chosen, at, density);
    if (tooClose.has(p.id)) stamp(context, close, at, density);
    if (offFloor.has(p.id)) cross(context, at, radius + 5);
    if (options.ids) label(context, String(p.id), { x: at.x, y: at.y - radius - 9 });
  }
  const pinned = state.show.frames[state.frame]?.pixels.filter((p) => p.robot !== null) ?? [];
  paintPins(context, camera, state.show.stage.radius_m, pinned);
  paintHandles(context, camera, state);
  paintGesture(context, camera, state);
}

function stamp(c: CanvasRenderingContext2D, sprite: ImageBitmap, at: Point, density: number) {
  const side = sprite.width / density;
  c.drawImage(sprite, at.x - side / 2, at.y - side / 2, side, side);
}

function cross(c: CanvasRenderingContext2D, at: Point, r: number) {
  c.strokeStyle = FLOOR.care;
  c.lineWidth = 2;
  c.beginPath();
  for (const s of [-1, 1]) {
    c.moveTo(at.x - r, at.y - s * r);
    c.lineTo(at.x + r, at.y + s * r);
  }
  c.stroke();
}

function label(c: CanvasRenderingContext2D, text: string, at: Point) {
  c.font = '11px system-ui, sans-serif';
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  c.strokeStyle = FLOOR.plate;
  c.lineWidth = 3;
  c.strokeText(text, at.x, at.y);
  c.fillStyle = FLOOR.ink;
  c.fillText(text, at.x, at.y);
}

function paintHandles(c: CanvasRenderingContext2D, camera: Camera, state: EditorState) {
  const handles = handlesOf(state, camera);
  const [turn, topLeft, , bottomRight] = handles;
  if (!turn || !topLeft || !bottomRight) return;
  c.strokeStyle = FLOOR.box;
  c.lineWidth = 1;
  const { x, y } = topLeft.at;
  c.strokeRect(x, y, bottomRight.at.x - x, bottomRight.at.y - y);
  c.beginPath();
  c.moveTo(turn.at.x, turn.at.y + 5);
  c.lineTo(turn.at.x, y);
  c.stroke();
  for (const { handle, at } of handles) {
    c.beginPath();
    if (handle.kind === 'turn') c.arc(at.x, at.y, 5.5, 0, 2 * Math.PI);
    else c.rect(at.x - 4, at.y - 4, 8, 8);
    c.fillStyle = FLOOR.plate;
    c.fill();
    c.strokeStyle = FLOOR.chosen;
    c.lineWidth = 1.5;
    c.stroke();
  }
}

function paintGesture(c: CanvasRenderingContext2D, camera: Camera, { overlay, show }: EditorState) {
  c.strokeStyle = FLOOR.guide;
  c.lineWidth = 1;
  const [w, d] = [show.stage.width_m / 2, show.stage.depth_m / 2];
  for (const guide of overlay.guides) {
    const ends =
      guide.axis === 'x'
        ? [
            { x: guide.at, y: -d },
            { x: guide.at, y: d },
          ]
        : [
            { x: -w, y: guide.at },
            { x: w, y: guide.at },
          ];
    c.beginPath();
    ends.forEach((end, i) => {
      const at = canvasFromStage(camera, end);
      if (i === 0) c.moveTo(at.x, at.y);
      else c.lineTo(at.x, at.y);
    });
    c.stroke();
  }
  if (overlay.marquee.length > 2) {
    c.beginPath();
    for (const corner of overlay.marquee) {
      const at = canvasFromStage(camera, corner);
      c.lineTo(at.x, at.y);
    }
    c.closePath();
    c.fillStyle = FLOOR.guideWash;
    c.fill();
    c.stroke();
  }
}
