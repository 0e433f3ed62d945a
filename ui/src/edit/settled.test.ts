import { expect, test } from 'vitest';
import { placePixels } from '../model/commands';
import { createEditor } from '../model/editor';
import { newShow } from '../model/show';
import { settledOf } from './settled';

test('a drag is seen when it ends, and not at all when it is given up', () => {
  const editor = createEditor(newShow('x', 2));
  const settled = settledOf(editor);
  const seen: number[] = [];
  settled.subscribe(() => seen.push(settled.get().show.frames[0]?.pixels[0]?.x ?? NaN));
  const move = (x: number) =>
    editor.change('Move', (show) => placePixels(show, 0, new Map([[0, { x, y: 0 }]])));
  editor.begin();
  move(0.1);
  move(0.2);
  expect(seen).toEqual([]);
  editor.commit('Move');
  expect(seen.at(-1)).toBe(0.2);
  editor.begin();
  move(0.3);
  editor.cancel();
  expect(seen.at(-1)).toBe(0.2);
  expect(settledOf(editor)).toBe(settled);
});
