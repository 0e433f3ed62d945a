import type { Making } from '../make/making';
import { useKeys } from '../parts/useKeys';
import { fitView, zoomView } from '../stage/ViewTools';
import * as acts from './acts';
import { useEditing } from './context';
import type { StageOptions } from './editing';
import { notify } from '../session/notices';
import { openMaking } from './makes';
import { nudgeMaking, openDrawing, removeChosenPoint } from './penActs';
import { chooseNextPoint, penLine, stopAdding } from '../make/pen';
import { openMenuByKey } from './menuEntries';
import { toggleFramesView } from './timeline/framesView';

/** Metres by which an arrow key moves pixels: alone, with Shift, with Alt. */
const STEPS = [
  ['', 0.01],
  ['shift+', 0.1],
  ['alt+', 0.001],
] as const;
const ARROWS = [
  ['ArrowLeft', -1, 0],
  ['ArrowRight', 1, 0],
  ['ArrowUp', 0, 1],
  ['ArrowDown', 0, -1],
] as const;

/** Most of the editor's keys; draws nothing. */
export function EditKeys() {
  const editing = useEditing();
  const { editor } = editing;
  const frame = () => editor.state.get().frame;
  const toggle = (name: keyof StageOptions) =>
    editing.options.update((l) => ({ ...l, [name]: !l[name] }));
  const nudge = (x: number, y: number) => {
    const making = editing.making.get();
    if (making) nudgeMaking(editing, making, { x, y });
    else acts.nudge(editing, x, y);
  };
  const withMaking = (act: (making: Making) => void) => {
    const making = editing.making.get();
    if (making) act(making);
  };
  const next = (by: 1 | -1) => {
    const making = editing.making.get();
    if (making && penLine(making)) chooseNextPoint(making, by);
    else if (!making) acts.selectNext(editing, by);
  };
  const notifyDone = (what: string | null, label: string) => {
    if (what) notify('info', `${label}: ${what}`);
  };
  const moves = STEPS.flatMap(([prefix, step]) =>
    ARROWS.map(([key, x, y]) => [`${prefix}${key}`, () => nudge(x * step, y * step)] as const),
  );
  useKeys([
    ...moves,
    ['mod+z', () => notifyDone(editor.undo(), 'Undone')],
    ['mod+shift+z', () => notifyDone(editor.redo(), 'Redone')],
    ['mod+y', () => notifyDone(editor.redo(), 'Redone')],
    ['mod+a', () => acts.selectAll(editing)],
    ['mod+i', () => acts.invertSelection(editing)],
    ['mod+d', () => acts.duplicateFrames(editing)],
    ['mod+Enter', () => acts.addFrame(editing)],
    ['mod+Delete', () => acts.deleteFrames(editing)],
    ['mod+Backspace', () => acts.deleteFrames(editing)],
    ['shift+PageUp', () => editor.goToFrame(frame() - 1, 'range')],
    ['shift+PageDown', () => editor.goToFrame(frame() + 1, 'range')],
    ['PageUp', () => editor.goToFrame(frame() - 1)],
    ['PageDown', () => editor.goToFrame(frame() + 1)],
    ['alt+PageUp', () => acts.shiftFrames(editing, -1)],
    ['alt+PageDown', () => acts.shiftFrames(editing, 1)],
    [']', () => next(1)],
    ['[', () => next(-1)],
    ['Enter', () => withMaking(stopAdding)],
    ['Delete', () => withMaking((making) => removeChosenPoint(editing, making))],
    ['Backspace', () => withMaking((making) => removeChosenPoint(editing, making))],
    ['b', () => openDrawing(editing)],
    ['mod+g', () => acts.group(editing)],
    ['mod+shift+g', () => acts.ungroup(editing)],
    ['ContextMenu', () => openMenuByKey(editing)],
    ['shift+F10', () => openMenuByKey(editing)],
    ['t', () => openMaking(editing, 'text')],
    ['s', () => openMaking(editing, 'shape')],
    ['v', () => editing.tool.set('arrow')],
    ['q', () => editing.tool.set('lasso')],
    ['i', () => editing.tool.set('eyedropper')],
    ['f', () => editing.tool.set('fill')],
    ['o', () => editing.tool.set('area')],
    ['m', () => toggle('snap')],
    ['n', () => toggle('ids')],
    ['h', () => toggle('ghosts')],
    ['w', () => toggle('routes')],
    ['l', toggleFramesView],
    ['space', () => editing.space.press()],
    ['0', () => fitView(editing.view)],
    ['[plus]', () => zoomView(editing.view, 1.4)],
    ['shift+[plus]', () => zoomView(editing.view, 1.4)],
    ['=', () => zoomView(editing.view, 1.4)],
    ['-', () => zoomView(editing.view, 1 / 1.4)],
    ['F2', () => editing.renaming.set(frame())],
  ]);
  return null;
}
