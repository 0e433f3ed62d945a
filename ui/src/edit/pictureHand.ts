import type { Point } from '../base/geometry';
import { lengthText } from '../base/units';
import type { Draft } from '../make/draft';
import type { Making } from '../make/making';
import {
  CORNERS,
  cornerAt,
  movedBy,
  pictureFromStage,
  pictureOf,
  scaledBy,
  stageFromPicture,
  turnedBy,
  type Corner,
  type Picture,
} from '../make/picture';
import { SIDES, stretchedBy, type Side, type Stretch } from '../make/stretch';
import { NO_OVERLAY } from '../model/editorState';
import type { Tool, Touch } from '../model/tool';
import { unitStore } from '../session/preferences';
import type { Camera } from '../stage/camera';

/** What a drag does to a picture: `scale` at a corner, `stretch` at a side. */
export type Grip =
  { kind: 'move' } | { kind: 'turn' } | ({ kind: 'scale' } & Corner) | ({ kind: 'stretch' } & Side);

/** Distance of the box of handles from the picture, CSS pixels. */
const GAP_PX = 16;
/** Distance of the knob that turns the picture from the upper side of the box, CSS pixels. */
const KNOB_PX = 26;
/** A side of the picture that is not longer than this gets no handle of its own, CSS pixels. */
const SIDE_PX = 40;
/** A press this near to a handle takes it, CSS pixels. */
const REACH_PX = 11;

export const pictureNow = (making: Making): Picture | null =>
  pictureOf(making.draft.get(), making.made.get());

/** The handles of a picture, stage metres: knob, corners, and if it `stretches` sides longer than `SIDE_PX`. */
export function gripsOf(
  picture: Picture,
  camera: Camera,
  stretches: boolean,
): { grip: Grip; at: Point }[] {
  const gap_m = GAP_PX / camera.scale;
  const corner = ({ sx, sy }: Corner) => {
    const { x, y } = cornerAt(picture, { sx, sy });
    return stageFromPicture(picture, { x: x + sx * gap_m, y: y + sy * gap_m });
  };
  const [low, high] = [cornerAt(picture, { sx: -1, sy: -1 }), cornerAt(picture, { sx: 1, sy: 1 })];
  const middle = { x: (low.x + high.x) / 2, y: (low.y + high.y) / 2 };
  const knob = { x: middle.x, y: high.y + gap_m + KNOB_PX / camera.scale };
  const side = ({ sx, sy }: Side) =>
    stageFromPicture(picture, {
      x: middle.x + sx * ((high.x - low.x) / 2 + gap_m),
      y: middle.y + sy * ((high.y - low.y) / 2 + gap_m),
    });
  const isLong = ({ sx }: Side) =>
    (sx === 0 ? high.x - low.x : high.y - low.y) * camera.scale > SIDE_PX;
  return [
    { grip: { kind: 'turn' }, at: stageFromPicture(picture, knob) },
    ...CORNERS.map((of) => ({ grip: { kind: 'scale', ...of } as const, at: corner(of) })),
    ...SIDES.filter((of) => stretches && isLong(of)).map((of) => ({
      grip: { kind: 'stretch', ...of } as const,
      at: side(of),
    })),
  ];
}

/** What a press takes: a handle, or the picture if the press is inside the box of handles; null: neither. */
export function gripAt(
  picture: Picture,
  camera: Camera,
  { at, reach_m }: Touch,
  stretches: boolean,
): Grip | null {
  const reach = Math.max(REACH_PX / camera.scale, reach_m);
  const near = gripsOf(picture, camera, stretches).find(
    (handle) => Math.hypot(handle.at.x - at.x, handle.at.y - at.y) < reach,
  );
  if (near) return near.grip;
  const p = pictureFromStage(picture, at);
  const [low, high] = [cornerAt(picture, { sx: -1, sy: -1 }), cornerAt(picture, { sx: 1, sy: 1 })];
  const gap_m = GAP_PX / camera.scale;
  const isInside =
    p.x > low.x - gap_m && p.x < high.x + gap_m && p.y > low.y - gap_m && p.y < high.y + gap_m;
  return isInside ? { kind: 'move' } : null;
}

/**
 * Moves, scales, stretches or turns the picture that is made. Shift: turning in steps of 15°, moving along one axis.
 * Alt: scaling and stretching about the middle.
 */
export function createPictureTool(making: Making, grip: Grip, stretch: Stretch | null): Tool {
  let from: { at: Point; picture: Picture; draft: Draft } | null = null;
  return {
    down(editor, { at }) {
      const picture = pictureNow(making);
      editor.begin();
      from = picture && { at, picture, draft: making.draft.get() };
    },
    move(editor, touch) {
      if (!from) return;
      const { stage } = editor.state.get().show;
      making.change(changed({ ...from, stretch }, grip, [from.at, touch.at], touch, stage));
      const unit = unitStore.get();
      const { size_m, center, turn } = { ...from.picture, ...pictureNow(making) };
      const hint = {
        move: `middle ${lengthText(center.x, unit)}, ${lengthText(center.y, unit)}`,
        stretch: `size ${lengthText(size_m, unit)}`,
        scale: `size ${lengthText(size_m, unit)}`,
        turn: `${Math.round((turn * 180) / Math.PI)}°`,
      }[grip.kind];
      editor.overlay({ ...NO_OVERLAY, hint });
    },
    up(editor) {
      from = null;
      // The show has not changed, so that this makes no mark: it ends the gesture and takes the hint away.
      editor.commit('Make');
    },
    cancel(editor) {
      const before = from?.draft;
      from = null;
      editor.cancel();
      if (before) {
        const { size_m, center, turn, points, shapeNumbers } = before;
        making.change({ size_m, center, turn, points, shapeNumbers });
      }
      return before !== undefined;
    },
  };
}

function changed(
  { picture, draft, stretch }: { picture: Picture; draft: Draft; stretch: Stretch | null },
  grip: Grip,
  drag: readonly [Point, Point],
  { shift, alt }: Touch,
  floor: { width_m: number; depth_m: number },
): Partial<Draft> {
  if (grip.kind === 'turn') return turnedBy(picture, drag, shift);
  if (grip.kind === 'stretch')
    return stretch ? stretchedBy({ picture, draft, stretch }, grip, drag, alt, floor) : {};
  if (grip.kind === 'scale') return scaledBy(picture, grip, drag, alt, floor);
  const [from, to] = drag;
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const isFlat = Math.abs(dx) >= Math.abs(dy);
  const by = shift ? { x: isFlat ? dx : 0, y: isFlat ? 0 : dy } : { x: dx, y: dy };
  return movedBy(picture, by, floor);
}

/** Moves the picture that is made by `by`, metres; nothing without a picture. */
export function nudgePicture(
  making: Making,
  by: Point,
  floor: { width_m: number; depth_m: number },
) {
  const picture = pictureNow(making);
  if (picture) making.change(movedBy(picture, by, floor));
}
