import { useEffect, useMemo } from 'react';
import { useStore } from '../base/store';
import type { EditorState } from '../model/editorState';
import type { Scene } from '../stage/scene';
import { StageCanvas } from '../stage/StageCanvas';
import { planTo } from '../make/drive';
import { pictureShown } from '../make/making';
import { useEditing } from './context';
import type { Editing } from './editing';
import { PixelTwin } from './PixelTwin';
import { litNow, shownLayer } from './light/lit';
import { shownMotion } from './motion/motionOverlay';
import { editScene, isSameOnStage, withMade } from './scene';
import { EmptyFrame } from './EmptyFrame';
import { StageMenu } from './StageMenu';
import { StageHint } from './StageHint';
import { StageTools } from './StageTools';
import { usePreviewSound } from './music/usePreviewSound';
import { usePreview } from './usePreview';
import { useHand } from './useHand';
import { stopAdding } from '../make/pen';
import { unitStore } from '../session/preferences';
import { useKeys } from '../parts/useKeys';
import styles from '../stage/stage.module.css';

/** Returns the same scene until one of its inputs changes. */
function rememberScene(editing: Editing): (now_ms: number) => Scene {
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

/** The floor of the editor. */
export function EditStage() {
  const editing = useEditing();
  const { hand, giveUp } = useHand(editing);
  const sceneAt = useMemo(() => rememberScene(editing), [editing]);
  const tool = useStore(editing.tool);
  const isHeld = useStore(editing.space.held);
  const routes = useStore(editing.options, (options) => options.routes);
  const { full } = editing;
  useEffect(() => (routes ? full.follow() : undefined), [routes, full]);
  usePreview(editing);
  usePreviewSound(editing);
  useKeys([
    [
      'Escape',
      (event) => {
        // A drag of the picture that is made was meant, not the Make panel.
        if (giveUp()) {
          event.stopImmediatePropagation();
          return;
        }
        const making = editing.making.get();
        if (making) {
          if (stopAdding(making)) event.stopImmediatePropagation();
          return;
        }
        if (editing.tool.get() !== 'arrow') editing.tool.set('arrow');
        else editing.editor.select([]);
        editing.preview.stop();
      },
    ],
  ]);
  return (
    <section
      className={styles.stage}
      aria-label="The floor"
      data-tool={isHeld ? 'hand' : tool}
      data-testid="stage"
    >
      <StageCanvas view={editing.view} sceneAt={sceneAt} pans={editing.space} hand={hand} />
      <StageTools />
      <StageMenu />
      <StageHint />
      <EmptyFrame />
      <PixelTwin />
    </section>
  );
}
