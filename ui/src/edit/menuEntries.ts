import type { Point } from '../base/geometry';
import { boxOf, centreOf } from '../base/geometry';
import { groupOf, groupsOf, wholeGroups } from '../model/groups';
import { obstacleAt, removeObstacle } from '../model/obstacles';
import { pixelAt, type Touch } from '../model/tool';
import { canvasFromStage } from '../stage/camera';
import { fitView } from '../stage/ViewTools';
import * as acts from './acts';
import type { Editing } from './editing';
import { openMaking } from './makes';
import type { MenuAt } from './menuAt';

/** An entry of a menu, or a line between groups of entries. `off`: it cannot be chosen now. */
export type MenuEntry = 'line' | { label: string; keys?: string; off?: boolean; act: () => void };

export function entriesOf(editing: Editing, about: MenuAt['about']): MenuEntry[] {
  if (about === 'pixels') return pixelEntries(editing);
  if (about === 'floor') return floorEntries(editing);
  const remove = () => editing.editor.change('No-go area', (show) => removeObstacle(show, about));
  return [{ label: 'Delete no-go area', act: remove }, 'line', ...floorEntries(editing)];
}

function pixelEntries(editing: Editing): MenuEntry[] {
  const { editor } = editing;
  const chosen = editor.chosenPixels();
  const several = chosen.length > 1;
  return [
    { label: 'Copy', keys: 'Ctrl C', act: () => void editor.copy() },
    { label: 'Paste', keys: 'Ctrl V', off: !editor.canPaste(), act: () => void editor.paste() },
    'line',
    {
      label: 'Group',
      keys: 'Ctrl G',
      off: !several || groupOf(chosen) !== null,
      act: () => acts.group(editing),
    },
    {
      label: 'Ungroup',
      keys: 'Ctrl Shift G',
      off: groupsOf(chosen).length === 0,
      act: () => acts.ungroup(editing),
    },
    'line',
    { label: 'Select same colour', act: () => acts.selectSameColour(editing) },
    { label: 'Invert selection', keys: 'Ctrl I', act: () => acts.invertSelection(editing) },
    'line',
    { label: 'Spread apart', off: !several, act: () => acts.spread(editing) },
    { label: 'Mirror left and right', off: !several, act: () => acts.mirror(editing, 'x') },
    { label: 'Mirror top and bottom', off: !several, act: () => acts.mirror(editing, 'y') },
  ];
}

function floorEntries(editing: Editing): MenuEntry[] {
  const { editor } = editing;
  const { history } = editor.state.get();
  const [back, forth] = [history.past.at(-1), history.future.at(-1)];
  return [
    { label: 'Select all', keys: 'Ctrl A', act: () => acts.selectAll(editing) },
    { label: 'Paste', keys: 'Ctrl V', off: !editor.canPaste(), act: () => void editor.paste() },
    'line',
    { label: 'Make words…', keys: 'T', act: () => openMaking(editing, 'text') },
    { label: 'Make a shape…', keys: 'S', act: () => openMaking(editing, 'shape') },
    'line',
    { label: 'Add a frame', keys: 'Ctrl Enter', act: () => acts.addFrame(editing) },
    { label: 'Duplicate frame', keys: 'Ctrl D', act: () => acts.duplicateFrames(editing) },
    'line',
    {
      label: back ? `Undo: ${back.label}` : 'Undo',
      keys: 'Ctrl Z',
      off: !back,
      act: () => void editor.undo(),
    },
    {
      label: forth ? `Redo: ${forth.label}` : 'Redo',
      keys: 'Ctrl Shift Z',
      off: !forth,
      act: () => void editor.redo(),
    },
    'line',
    { label: 'Fit floor', keys: '0', act: () => fitView(editing.view) },
  ];
}

/**
 * Opens the menu at `at`, CSS pixels. A pixel under the pointer that is not selected becomes the selection, with its
 * group. Without a pixel the selection ends.
 */
export function openMenu(editing: Editing, at: Point, touch: Touch) {
  const { editor, menu } = editing;
  const hit = pixelAt(editor, touch);
  const { selection, show } = editor.state.get();
  if (hit !== null) {
    if (!selection.has(hit)) editor.select(wholeGroups(editor.current(), [hit]));
    menu.set({ at, about: 'pixels' });
    return;
  }
  editor.select([]);
  const area = obstacleAt(show.stage.obstacles, touch.at);
  menu.set({ at, about: area >= 0 ? area : 'floor' });
}

/** Opens the menu by keyboard at the chosen pixels, or in the middle of the view; not while the Make panel is open. */
export function openMenuByKey(editing: Editing) {
  if (editing.making.get()) return;
  const { camera, width_px, height_px } = editing.view.get();
  const chosen = editing.editor.chosenPixels();
  const middle = { x: width_px / 2, y: height_px / 2 };
  const at = canvasFromStage(camera, centreOf(boxOf(chosen)));
  const open: MenuAt = chosen.length > 0 ? { at, about: 'pixels' } : { at: middle, about: 'floor' };
  // A menu that opens at once receives the same key, and closes.
  setTimeout(() => editing.menu.set(open));
}
