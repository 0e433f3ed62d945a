import type { EditorState } from '../model/editorState';
import type { Dot } from '../base/geometry';
import { pathsTo } from '../model/plannedPaths';
import { hollowOf } from '../model/dots';
import { unitStore } from '../session/preferences';
import { pixelsOf } from '../make/frame';
import type { Colours } from '../light/lights';
import type { Making } from '../make/making';
import { penLine } from '../make/pen';
import type { MakeAnswer, Plan } from '../api/types.gen';
import type { Frame } from '../model/show';
import { dotsAt, timelineOf } from '../model/timeline';
import type { Layer } from '../model/layers';
import type { ShownMotion } from '../model/motionTool';
import { paintLayer } from './light/layerOverlay';
import { litDots, litPixels } from './light/lit';
import type { Camera } from '../stage/camera';
import { floorOf, type Scene } from '../stage/scene';
import type { StageOptions } from './editing';
import { paintMotion } from './motion/motionOverlay';
import { paintOverlay } from './overlay';
import { paintPen } from './penOverlay';
import { pictureNow } from './pictureHand';
import { isStretchable } from '../make/stretch';
import { paintPicture } from './pictureOverlay';

const NOTHING: readonly never[] = [];

const ghost = (frame: Frame | undefined, alpha: number): Dot[] =>
  frame?.pixels.map((p) => ({ x: p.x, y: p.y, color: p.color, alpha })) ?? [];

let ghosts: { before?: Frame; after?: Frame; dots: readonly Dot[] } = { dots: NOTHING };

/** Dots of the frames before and after; the same list while these stay, so that a drag does not paint them anew. */
function ghostsOf({ show, frame }: EditorState): readonly Dot[] {
  const [before, after] = [show.frames[frame - 1], show.frames[frame + 1]];
  if (ghosts.before !== before || ghosts.after !== after)
    ghosts = { before, after, dots: [...ghost(before, 0.8), ...ghost(after, 0.45)] };
  return ghosts.dots;
}

/** The state with the made pixels in place of those of the frame with `key`, and nothing selected; null: as it is. */
export function withMade(
  state: EditorState,
  key: number,
  answer: MakeAnswer | null | undefined,
): EditorState {
  if (!answer) return state;
  const pixels = pixelsOf(answer);
  const frames = state.show.frames.map((f) => (f.key === key ? { ...f, pixels } : f));
  return { ...state, show: { ...state.show, frames }, selection: NO_SELECTION };
}

const NO_SELECTION: ReadonlySet<number> = new Set();

/** The robots' colours, and the layer and the motion with handles on the stage; null: none. */
export interface SceneLight {
  lit: Colours | null;
  layer: Layer | null;
  /** The motion with its handles on the stage. */
  motion?: ShownMotion | null;
}

const NO_LIGHT: SceneLight = { lit: null, layer: null };

/**
 * Whether the stage shows the same in both states, if no moment of a preview is on it. A drag on the timeline changes
 * only times, so that the floor need not be drawn anew.
 */
export function isSameOnStage(a: EditorState, b: EditorState): boolean {
  if (a === b) return true;
  const [before, after] = [a.show, b.show];
  const isSameFrame = (index: number) =>
    before.frames[index]?.key === after.frames[index]?.key &&
    before.frames[index]?.pixels === after.frames[index]?.pixels &&
    before.frames[index]?.motion === after.frames[index]?.motion;
  return (
    a.frame === b.frame &&
    a.selection === b.selection &&
    a.overlay === b.overlay &&
    before.stage === after.stage &&
    [a.frame - 1, a.frame, a.frame + 1].every(isSameFrame)
  );
}

/** What the editor's stage shows: the frame on it, or with a plan the moment `time_s`, seconds from the first drive. */
export function editScene(
  state: EditorState,
  options: StageOptions,
  plan: Plan | null,
  time_s: number | null,
  making: Making | null = null,
  { lit, layer, motion }: SceneLight = NO_LIGHT,
): Scene {
  const { show, frame } = state;
  const base = { ...floorOf(show.stage, unitStore.get()), errors: NOTHING };
  if (time_s !== null && plan) {
    const filled = litDots(dotsAt(show, plan, timelineOf(show, plan), time_s), lit);
    const hollow = options.ghosts ? hollowOf(show.frames[frame]) : NOTHING;
    return {
      ...base,
      filled,
      hollow,
      paths: options.routes ? pathsTo(plan, show, frame) : NOTHING,
      ...(layer ? { overlay: (context, camera) => paintLayer(context, camera, layer) } : {}),
    };
  }
  const pixels = show.frames[frame]?.pixels ?? [];
  return {
    ...base,
    filled: litPixels(pixels, plan?.transitions[frame], lit),
    hollow: options.ghosts ? ghostsOf(state) : NOTHING,
    paths: options.routes ? pathsTo(plan, show, frame) : NOTHING,
    overlay(context, camera) {
      paintOverlay(context, camera, state, options);
      if (making) paintMaking(context, camera, making);
      if (layer) paintLayer(context, camera, layer);
      if (motion) paintMotion(context, camera, motion);
    },
  };
}

function paintMaking(context: CanvasRenderingContext2D, camera: Camera, making: Making) {
  const picture = pictureNow(making);
  if (picture) paintPicture(context, camera, picture, isStretchable(making.draft.get()));
  const line = penLine(making);
  if (line) paintPen(context, camera, line);
}
