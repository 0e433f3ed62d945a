import type { Point } from '../base/geometry';
import { useEffect, useMemo } from 'react';
import { useStore } from '../base/store';
import { lengthText } from '../base/units';
import { unitStore } from '../session/preferences';
import type { Making } from '../make/making';
import { stretchOf } from '../make/stretch';
import { createArrowTool } from '../model/arrowTool';
import { createEyedropper } from '../model/eyedropper';
import { createFillTool } from '../model/fillTool';
import { createLayerTool, layerGripAt } from '../model/layerTool';
import { createMotionTool, motionGripAt } from '../model/motionTool';
import { createObstacleTool } from '../model/obstacleTool';
import { createLassoTool } from '../model/lassoTool';
import { pixelAt, type Tool, type Touch } from '../model/tool';
import { createTransformTool } from '../model/transformTool';
import { gridStep, stageFromCanvas } from '../stage/camera';
import type { Hand } from '../stage/pointer';
import * as acts from './acts';
import { keepColour, type Editing, type ToolName } from './editing';
import { handleAt } from './overlay';
import { penFor } from './penTool';
import { createPictureTool, gripAt, pictureNow } from './pictureHand';
import { shownLayer } from './light/lit';
import { applyMotion } from './motion/motionActs';
import { motionAtHand } from './motion/motionOverlay';
import { openMenu } from './menuEntries';

/** How far a mouse and a finger may miss, CSS pixels. */
const REACH_PX = { mouse: 9, pen: 12, touch: 20 } as const;

const reachOf = (event: MouseEvent) =>
  REACH_PX[(event as PointerEvent).pointerType as keyof typeof REACH_PX] ?? REACH_PX.mouse;

/** The grid that is snapped to: a fifth of what is drawn, but no finer than a centimetre. */
const snapStep = (scale: number) => Math.max(0.01, gridStep(scale) / 10);

/** A second press within this time and distance is a double click, milliseconds and CSS pixels. */
const AGAIN_MS = 400;
const AGAIN_PX = 10;

/** Tools that the handles of the selection would be in the way of. */
const NO_HANDLES: ReadonlySet<ToolName> = new Set(['fill', 'area']);

/** The hand moves the view, which is not a matter of tools. */
const IDLE: Tool = { down() {}, move() {}, up() {}, cancel: () => false };

function createTool(editing: Editing): Tool {
  switch (editing.tool.get()) {
    case 'hand':
      return IDLE;
    case 'lasso':
      return createLassoTool();
    case 'eyedropper':
      return createEyedropper((color) => {
        if (editing.editor.state.get().selection.size > 0) acts.paint(editing, color);
        else keepColour(editing, color);
        editing.tool.set('arrow');
      });
    case 'fill':
      return createFillTool(editing.color.get);
    case 'area':
      return createObstacleTool((m) => lengthText(m, unitStore.get()));
    case 'arrow':
      return createArrowTool({
        grid_m: () => (editing.options.get().snap ? snapStep(editing.view.get().camera.scale) : 0),
        neighbours: () => editing.options.get().snap,
        lengthText: (m) => lengthText(m, unitStore.get()),
      });
  }
}

/** Sends pointer events to the chosen tool, or to the handle under the pointer; Escape cancels the gesture. */
export function useHand(editing: Editing): { hand: Hand; giveUp: () => boolean } {
  const name = useStore(editing.tool);
  const led = useMemo(() => {
    void name;
    return lead(editing);
  }, [editing, name]);
  useEffect(() => () => void led.giveUp(), [led]);
  return led;
}

function lead(editing: Editing): { hand: Hand; giveUp: () => boolean } {
  const { editor, view } = editing;
  const chosen = createTool(editing);
  let active: Tool | null = null;
  const presses = createPresses();
  const touch = (at: Point, event: MouseEvent, adds = false): Touch => {
    const { camera } = view.get();
    return {
      at: stageFromCanvas(camera, at),
      reach_m: reachOf(event) / camera.scale,
      shift: event.shiftKey || adds,
      alt: event.altKey,
      ctrl: event.ctrlKey || event.metaKey,
      again: presses.isAgain(),
    };
  };
  /** A finger that means a pixel is not given the handle beside it. */
  const handleUnder = (at: Point, event: PointerEvent) => {
    const [state, { camera }] = [editor.state.get(), view.get()];
    const near = handleAt(state, camera, at, 0);
    return (
      near ??
      (pixelAt(editor, touch(at, event)) === null
        ? handleAt(state, camera, at, reachOf(event))
        : null)
    );
  };
  const pictureTool = (making: Making, at: Touch): Tool | null => {
    const picture = pictureNow(making);
    const stretch = stretchOf(making.draft.get(), editing.choices.get()?.shapes ?? []);
    const grip = picture && gripAt(picture, view.get().camera, at, stretch !== null);
    return grip && createPictureTool(making, grip, stretch);
  };
  const giveUp = () => {
    const busy = active?.cancel(editor) ?? false;
    active = null;
    return busy;
  };
  return {
    giveUp,
    hand: {
      down(at, event, adds) {
        const making = editing.making.get();
        // The Make panel shows pixels that the frame does not have yet: only their picture is dragged.
        if (making) {
          presses.press(at, event.timeStamp);
          const press = touch(at, event, adds);
          active = penFor(making, press) ?? pictureTool(making, press);
          active?.down(editor, press);
          return;
        }
        const press = touch(at, event, adds);
        const layer = shownLayer(editing);
        const grip = layer && layerGripAt(layer.layer, press);
        if (layer && grip) {
          active = createLayerTool(layer.index, grip, (m) => lengthText(m, unitStore.get()));
          active.down(editor, press);
          return;
        }
        const motion = motionAtHand(editing);
        const nth = motion && motionGripAt(motion, press);
        if (motion && nth !== null) {
          active = createMotionTool(
            motion,
            nth,
            (m) => lengthText(m, unitStore.get()),
            editing.motionDrawn.set,
            (changed) => void applyMotion(editing, changed),
          );
          active.down(editor, press);
          return;
        }
        editing.preview.stop();
        const handle = NO_HANDLES.has(editing.tool.get()) ? null : handleUnder(at, event);
        active = handle ? createTransformTool(handle) : chosen;
        presses.press(at, event.timeStamp);
        active.down(editor, touch(at, event, adds));
      },
      move: (at, event) => active?.move(editor, touch(at, event)),
      up(at, event, adds) {
        active?.up(editor, touch(at, event, adds));
        active = null;
      },
      lost: () => void giveUp(),
      menu(at, event) {
        if (editing.making.get()) {
          active?.up(editor, touch(at, event));
          active = null;
          return;
        }
        giveUp();
        editing.preview.stop();
        openMenu(editing, at, touch(at, event));
      },
    },
  };
}

/** Tells the second and further presses of a double click from the first. */
function createPresses() {
  let last = { at: { x: 0, y: 0 }, ms: -Infinity };
  let again = false;
  return {
    isAgain: () => again,
    press(at: Point, ms: number) {
      const isNear = Math.hypot(at.x - last.at.x, at.y - last.at.y) < AGAIN_PX;
      again = isNear && ms - last.ms < AGAIN_MS;
      last = { at, ms };
    },
  };
}
