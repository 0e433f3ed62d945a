import { expect, test } from 'vitest';
import { createArrowTool } from './arrowTool';
import { addFrame, deleteFrames, recolour, setFrames } from './commands';
import { createEditor } from './editor';
import { createEyedropper } from './eyedropper';
import { createLassoTool } from './lassoTool';
import { newShow, type Show } from './show';
import type { Tool, Touch } from './tool';
import { createTransformTool } from './transformTool';

/** Uses a tool on an editor with pixels 0, 1, 2 at x = 0, 0.5, 1 and y = 0, in stage metres. */
function hand(
  tool: Tool = createArrowTool({ grid_m: () => 0, neighbours: () => false, lengthText }),
) {
  const start = newShow('x', 3);
  const frames = start.frames.map((f) => ({
    ...f,
    pixels: f.pixels.map((p, i) => ({ ...p, x: i * 0.5, y: 0 })),
  }));
  const editor = createEditor({ ...start, frames });
  const touch = (x: number, y: number, over: Partial<Touch> = {}): Touch => ({
    at: { x, y },
    reach_m: 0.03,
    shift: false,
    alt: false,
    ctrl: false,
    again: false,
    ...over,
  });
  return {
    editor,
    click(x: number, y: number, over?: Partial<Touch>) {
      tool.down(editor, touch(x, y, over));
      tool.up(editor, touch(x, y, over));
    },
    drag(points: [number, number][], over?: Partial<Touch>, end = true) {
      points.forEach(([x, y], i) => (i === 0 ? tool.down : tool.move)(editor, touch(x, y, over)));
      const [x, y] = points[points.length - 1] ?? [0, 0];
      if (end) tool.up(editor, touch(x, y, over));
    },
    escape: () => tool.cancel(editor),
    chosen: () => [...editor.state.get().selection].sort(),
    places: () => editor.current()?.pixels.map((p) => [round(p.x), round(p.y)]),
    marks: () => editor.state.get().history.past.map((m) => m.label),
  };
}
const lengthText = (m: number) => `${Math.round(m * 1000)} mm`;
const round = (n: number) => Math.round(n * 1e6) / 1e6 + 0;

test('click chooses, Shift adds and takes away, the floor chooses none', () => {
  const h = hand();
  h.click(0, 0);
  h.click(0.51, 0.01, { shift: true });
  expect(h.chosen()).toEqual([0, 1]);
  h.click(0, 0, { shift: true });
  expect(h.chosen()).toEqual([1]);
  h.click(0.2, 0.3);
  expect(h.chosen()).toEqual([]);
});

test('a drag is one mark, moves all that is chosen, and Escape restores', () => {
  const h = hand();
  h.click(0, 0);
  h.click(0.5, 0, { shift: true });
  h.drag([[0, 0], [0.05, 0], [0.1, 0.2]]); // prettier-ignore
  expect(h.places()).toEqual([[0.1, 0.2], [0.6, 0.2], [1, 0]]); // prettier-ignore
  expect(h.marks()).toEqual(['Move']);
  h.drag([[0.1, 0.2], [1, 1]], {}, false); // prettier-ignore
  expect(h.escape()).toBe(true);
  expect(h.places()?.[0]).toEqual([0.1, 0.2]);
  expect(h.marks()).toEqual(['Move']);
});

test('Shift keeps a drag on one axis', () => {
  const h = hand();
  h.click(1, 0);
  h.drag([[1, 0], [1.2, 0.05]], { shift: true }); // prettier-ignore
  expect(h.places()?.[2]?.[1]).toBe(0);
});

test('a drag snaps to grid and neighbours and says how far it is', () => {
  const tool = createArrowTool({ grid_m: () => 0.1, neighbours: () => true, lengthText });
  const h = hand(tool);
  h.drag([[0, 0], [0.49, 0.29]], {}, false); // prettier-ignore
  expect(h.places()?.[0]).toEqual([0.5, 0.3]);
  expect(h.editor.state.get().overlay.guides).toEqual([{ axis: 'x', at: 0.5 }]);
  expect(h.editor.state.get().overlay.hint).toContain('nearest 300 mm');
});

test('marquee and lasso', () => {
  const h = hand();
  h.drag([[-0.1, -0.1], [0.6, 0.1]]); // prettier-ignore
  expect(h.chosen()).toEqual([0, 1]);
  const l = hand(createLassoTool());
  l.drag([[0.4, -0.2], [1.2, -0.2], [1.2, 0.2], [0.4, 0.2]]); // prettier-ignore
  expect(l.chosen()).toEqual([1, 2]);
});

test('turn and scale', () => {
  const turn = hand(createTransformTool({ kind: 'turn' }));
  turn.editor.select([0, 1, 2]);
  turn.drag([[1.5, 0], [0.5, 1]]); // prettier-ignore
  expect(turn.places()).toEqual([[0.5, -0.5], [0.5, 0], [0.5, 0.5]]); // prettier-ignore
  const scale = hand(createTransformTool({ kind: 'scale', sx: 1, sy: 0 }));
  scale.editor.select([0, 1, 2]);
  scale.drag([[1, 0], [1.2, 0]]); // prettier-ignore
  expect(scale.places()).toEqual([[0, 0], [0.6, 0], [1.2, 0]]); // prettier-ignore
  expect(scale.marks()).toEqual(['Scale']);
});

test('the eyedropper takes a colour', () => {
  const taken: number[] = [];
  hand(createEyedropper((c) => taken.push(c))).click(0.5, 0);
  expect(taken).toEqual([0xffc878]);
});

test('forty steps back and forth, jumping to the frame that changed', () => {
  const { editor } = hand();
  const shows: Show[] = [editor.state.get().show];
  editor.change('Add', (show) => addFrame(show, 0));
  shows.push(editor.state.get().show);
  for (let i = 2; i <= 40; i++) {
    editor.goToFrame(i % 2);
    editor.change('Colour', (show, s) => recolour(show, s.frame, new Map([[i % 3, i]])));
    shows.push(editor.state.get().show);
  }
  for (let i = 39; i >= 0; i--) {
    editor.undo();
    expect(editor.state.get().show).toBe(shows[i]);
  }
  expect(editor.undo()).toBeNull();
  for (let i = 1; i <= 40; i++) editor.redo();
  expect(editor.state.get().show).toBe(shows[40]);
  editor.goToFrame(1);
  editor.undo();
  expect(editor.state.get().frame).toBe(0);
  editor.change('Name', (show) => setFrames(show, [0], { name: 'n' }));
  expect(editor.redo()).toBeNull();
});

test('undoing a deletion brings the frame back to the stage', () => {
  const { editor } = hand();
  editor.change('Add', (show) => addFrame(show, 0));
  editor.goToFrame(1);
  editor.change('Delete', (show) => deleteFrames(show, [1]));
  expect(editor.state.get().frame).toBe(0);
  editor.undo();
  expect(editor.state.get().frame).toBe(1);
});

test('copied pixels are pasted into another frame with place and colour', () => {
  const { editor } = hand();
  editor.change('Add', (show) => addFrame(show, 0));
  editor.change('Colour', (show) => recolour(show, 0, new Map([[1, 0x0000ff]])));
  editor.select([1]);
  expect(editor.copy()).toBe(1);
  editor.goToFrame(1);
  expect(editor.paste()).toBe(1);
  expect(editor.current()?.pixels[1]?.color).toBe(0x0000ff);
});

test('several frames are chosen at once', () => {
  const { editor } = hand();
  for (let i = 0; i < 3; i++) editor.change('Add', (show) => addFrame(show, i));
  editor.goToFrame(1);
  editor.goToFrame(3, 'range');
  expect([...editor.state.get().frames]).toEqual([1, 2, 3]);
  editor.goToFrame(2, 'range');
  expect([...editor.state.get().frames]).toEqual([1, 2]);
  editor.goToFrame(3, 'range');
  editor.goToFrame(0, 'toggle');
  expect(editor.state.get().frames.size).toBe(4);
  editor.chooseFrames([2, 3, 99]);
  expect([...editor.state.get().frames]).toEqual([2, 3]);
  expect(editor.state.get().frame).toBe(2);
  editor.goToFrame(2, 'toggle');
  expect([...editor.state.get().frames]).toEqual([3]);
  expect(editor.state.get().frame).toBe(3);
  editor.goToFrame(3, 'toggle');
  expect([...editor.state.get().frames]).toEqual([3]);
});

test('what another screen saved is one mark that can be undone, and is not saved again', () => {
  const { editor } = hand();
  editor.change('Colour', (show) => recolour(show, 0, new Map([[1, 0x0000ff]])));
  const { changes, show: mine } = editor.state.get();
  editor.adopt(recolour(mine, 0, new Map([[2, 0xff0000]])));
  expect(editor.state.get().changes).toBe(changes);
  expect(editor.undo()).toBe('Changes of another screen');
  expect(editor.state.get().show).toBe(mine);
  expect(editor.undo()).toBe('Colour');
});

test('the history leads to any of its states', () => {
  const { editor } = hand();
  const shows: Show[] = [editor.state.get().show];
  for (let i = 1; i <= 4; i++) {
    editor.change('Colour', (show) => recolour(show, 0, new Map([[0, i]])));
    shows.push(editor.state.get().show);
  }
  for (const at of [1, 3, 0, 4, 4, 2]) {
    editor.travelTo(at);
    expect(editor.state.get().show).toBe(shows[at]);
    expect(editor.state.get().history.past).toHaveLength(at);
  }
  editor.undo();
  expect(editor.state.get().show).toBe(shows[1]);
  editor.travelTo(99);
  expect(editor.state.get().show).toBe(shows[4]);
});
