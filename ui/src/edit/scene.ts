import type { Plan } from '../api/types.gen';
import { pathsTo } from '../live/paths';
import type { EditorState } from '../model/editor';
import { dotsAt, timelineOf } from '../model/timeline';
import type { Dot, Scene } from '../stage/scene';
import type { Looks } from './editing';
import { paintOverlay } from './overlay';

const ghost = (state: EditorState, index: number, alpha: number): Dot[] =>
  state.show.frames[index]?.pixels.map((p) => ({ x: p.x, y: p.y, color: p.color, alpha })) ?? [];

/** What the editor's stage shows: the frame on it, or the plan at a moment. */
export function editScene(
  state: EditorState,
  looks: Looks,
  plan: Plan | null,
  moment: number | null,
): Scene {
  const { show, frame } = state;
  const { stage } = show;
  const base = {
    width_m: stage.width_m,
    depth_m: stage.depth_m,
    radius_m: stage.radius_m,
    obstacles: stage.obstacles,
    grid: true,
    errors: [],
  };
  if (moment !== null && plan) {
    const filled = dotsAt(show, plan, timelineOf(show, plan), moment);
    return { ...base, filled, hollow: [], paths: [] };
  }
  const pixels = show.frames[frame]?.pixels ?? [];
  return {
    ...base,
    filled: pixels.map((p) => ({ x: p.x, y: p.y, color: p.color, alpha: 1 })),
    hollow: looks.ghosts
      ? [...ghost(state, frame - 1, 0.55), ...ghost(state, frame + 1, 0.28)]
      : [],
    paths: looks.ways ? pathsTo(plan, show, frame) : [],
    overlay: (context, camera) => paintOverlay(context, camera, state, looks),
  };
}
