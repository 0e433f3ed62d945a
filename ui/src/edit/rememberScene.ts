import { planTo } from '../make/drive';
import { pictureShown } from '../make/making';
import type { EditorState } from '../model/editorState';
import { unitStore } from '../session/preferences';
import type { Scene } from '../stage/scene';
import type { Editing } from './editing';
import { litNow, shownLayer } from './light/lit';
import { shownMotion } from './motion/motionOverlay';
import { editScene, isSameOnStage, withMade } from './scene';

type SceneAt = (now_ms: number) => Scene;

/** A function of the time that gives the editor's scene: the same object until one of its inputs changes. */
export function rememberScene(editing: Editing): SceneAt {
  let inputs: unknown[] = [];
  let scene: Scene | null = null;
  let drawn = editing.editor.state.get();
  return (now_ms) => {
    const latest = editing.editor.state.get();
    const [options, time_s] = [editing.options.get(), editing.preview.time_s.get()];
    const making = editing.making.get();
    const isSame = time_s === null && !making && isSameOnStage(drawn, latest);
    const state = isSame ? drawn : latest;
    drawn = state;
    const shown = making && pictureShown(making);
    const drives = making && making.made.get().drives;
    const full = editing.full.plan.get();
    const lit = making ? null : litNow(editing, full, time_s, now_ms);
    const layer = making ? null : (shownLayer(editing)?.layer ?? null);
    const now = [
      state,
      lit,
      layer,
      making?.draft.get(),
      making?.pen.get(),
      shown,
      options,
      full,
      editing.moving.get(),
      editing.motionDrawn.get(),
      drives,
      time_s,
      unitStore.get(),
    ];
    if (!scene || now.some((input, i) => input !== inputs[i])) {
      inputs = now;
      const plan = making ? drives && planTo(drives, making.at.get(), state.frame) : full;
      scene = editScene(
        making ? withMade(state, making.frame, shown) : state,
        options,
        plan,
        time_s,
        making,
        { lit, layer, motion: making ? null : motionDrawn(editing, state) },
      );
    }
    return scene;
  };
}

const motionDrawn = ({ moving, motionDrawn }: Editing, state: EditorState) =>
  shownMotion(state, moving.get(), motionDrawn.get());

/** `sceneAt`, but while the audience view covers the stage the last scene, so that nothing is drawn. */
export function unlessCovered({ audience }: Editing, sceneAt: SceneAt): SceneAt {
  let last: Scene | null = null;
  return (now_ms) => {
    if (!last || !audience.get()) last = sceneAt(now_ms);
    return last;
  };
}
