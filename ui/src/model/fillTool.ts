import type { Rgb } from '../base/colour';
import { recolour } from './commands';
import type { Editor } from './editor';
import type { Pixel } from './show';
import { pixelAt, type Tool, type Touch } from './tool';

/** Colours pixels. A click colours a pixel and its patch of one colour; a drag colours the pixels that it passes. */
export function createFillTool(colour: () => Rgb): Tool {
  let passed: Set<number> | null = null;
  const pass = (editor: Editor, touch: Touch) => {
    const id = pixelAt(editor, touch);
    if (id === null || passed?.has(id)) return;
    passed?.add(id);
    paint(editor, [id]);
  };
  const paint = (editor: Editor, ids: Iterable<number>) => {
    const colors = new Map([...ids].map((id) => [id, colour()]));
    editor.change('Fill', (show, { frame }) => recolour(show, frame, colors));
  };
  let before: readonly Pixel[] = [];
  return {
    down(editor, touch) {
      before = editor.current()?.pixels ?? [];
      passed = new Set();
      editor.begin();
      pass(editor, touch);
    },
    move: (editor, touch) => {
      if (passed) pass(editor, touch);
    },
    up(editor) {
      const [only, ...more] = passed ?? [];
      if (only !== undefined && more.length === 0) paint(editor, patchOf(before, only));
      passed = null;
      editor.commit('Fill');
    },
    cancel(editor) {
      const busy = passed !== null;
      passed = null;
      editor.cancel();
      return busy;
    },
  };
}

/**
 * Greatest distance of two neighbours in a patch, as a factor of the larger of their distances to the nearest pixel of
 * their colour. Above 1.41, a square's diagonal, because spacing is uneven. A larger factor joins patches across gaps.
 */
const BESIDE = 1.75;

/** Ids of the patch of pixel `id`: pixels of its colour that a chain of neighbours connects with it. */
export function patchOf(pixels: readonly Pixel[], id: number): Set<number> {
  const color = pixels.find((p) => p.id === id)?.color;
  const same = pixels.filter((p) => p.color === color);
  const usual = new Map(same.map((p) => [p.id, nearest2(same, p)]));
  const found = new Set([id]);
  const open = same.filter((p) => p.id === id);
  for (let from = open.pop(); from; from = open.pop()) {
    for (const to of same) {
      if (found.has(to.id)) continue;
      const gap2 = Math.max(usual.get(from.id) ?? 0, usual.get(to.id) ?? 0) * BESIDE ** 2;
      if (distance2(from, to) > gap2) continue;
      found.add(to.id);
      open.push(to);
    }
  }
  return found;
}

/** Square of the distance to the nearest other pixel, square metres; 0: there is no other one. */
function nearest2(pixels: readonly Pixel[], from: Pixel): number {
  let least = Infinity;
  for (const to of pixels) if (to.id !== from.id) least = Math.min(least, distance2(from, to));
  return Number.isFinite(least) ? least : 0;
}

const distance2 = (a: Pixel, b: Pixel) => (a.x - b.x) ** 2 + (a.y - b.y) ** 2;
