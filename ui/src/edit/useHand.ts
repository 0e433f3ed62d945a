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

/** How far a pointer may miss what is meant, CSS pixels. */
const REACH_PX = { mouse: 9, pen: 12, touch: 20 } as const;

const reachOf = (event: MouseEvent) =>
  REACH_PX[(event as PointerEvent).pointerType as keyof typeof REACH_PX] ?? REACH_PX.mouse;

/** Step of the grid that is snapped to, metres: a tenth of the grid step at this zoom, but at least a centimetre. */
const snapStep = (scale: number) => Math.max(0.01, gridStep(scale) / 10);

/** A press within this time of the last one may be a double click, milliseconds. */
const AGAIN_MS = 400;
/** A press nearer than this to the last one may be a double click, CSS pixels. */
const AGAIN_PX = 10;

/** Tools with which the handles of the selection do not work, because they would be in the way. */
const NO_HANDLES: ReadonlySet<ToolName> = new Set(['fill', 'area']);

/** A tool that does nothing, for the hand: the view itself handles its drags. */
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

/**
 * Sends pointer events to a handle under the pointer, of the Make panel, a layer, a motion or the selection, else to
 * the chosen tool. `giveUp` cancels the gesture and answers whether there was one.
 */
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
  /** The handle of the selection under a pointer. One that is only near counts if no pixel is under the pointer. */
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
        // With the Make panel open, the stage shows pixels that the frame does not have yet: they cannot be dragged.
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

/** Notes presses and tells whether the last one was near the one before it in time and place: a double click. */
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
