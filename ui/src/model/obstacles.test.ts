import { expect, test } from 'vitest';
import { createEditor } from './editor';
import { limitOf, setLimit } from './limits';
import { readShow, writeShow } from './json';
import * as o from './obstacles';
import { createObstacleTool } from './obstacleTool';
import { newShow } from './show';

const touch = (x: number, y: number, alt = false) => ({
  at: { x, y },
  reach_m: 0.03,
  shift: false,
  alt,
  ctrl: false,
  again: false,
});

test('an area is drawn, moved, undone; a click draws none, Escape gives up', () => {
  const editor = createEditor(newShow('x', 1));
  const tool = createObstacleTool((m) => `${m} m`);
  const areas = () => editor.state.get().show.stage.obstacles;
  const drag = (ax: number, ay: number, bx: number, by: number, alt = false) => {
    tool.down(editor, touch(ax, ay, alt));
    tool.move(editor, touch((ax + bx) / 2, (ay + by) / 2, alt));
    tool.move(editor, touch(bx, by, alt));
    tool.up(editor, touch(bx, by, alt));
  };
  drag(0.5, 0.5, 0, 0);
  expect(areas()).toEqual([{ kind: 'rect', minX: 0, minY: 0, maxX: 0.5, maxY: 0.5 }]);
  drag(0.25, 0.25, -0.75, 0.25);
  expect(areas()).toEqual([{ kind: 'rect', minX: -1, minY: 0, maxX: -0.5, maxY: 0.5 }]);
  drag(1, 1, 1.3, 1.4, true);
  expect(areas()[1]).toMatchObject({ kind: 'disc', x: 1, y: 1 });
  tool.down(editor, touch(0, -1));
  tool.up(editor, touch(0, -1));
  expect(areas()).toHaveLength(2);
  tool.down(editor, touch(0, -1));
  tool.move(editor, touch(1, -1.4));
  expect(tool.cancel(editor)).toBe(true);
  expect(areas()).toHaveLength(2);
  expect([editor.undo(), editor.undo(), editor.undo()]).toEqual(['No-go area', 'Move no-go area', 'No-go area']); // prettier-ignore
  expect(areas()).toEqual([]);
});

test('areas are found from the top and taken away', () => {
  const disc = { kind: 'disc' as const, x: 0, y: 0, radius_m: 0.5 };
  const rect = { kind: 'rect' as const, minX: 0, minY: 0, maxX: 1, maxY: 1 };
  const show = o.addObstacle(o.addObstacle(newShow('x', 1), disc), rect);
  expect(o.obstacleAt(show.stage.obstacles, { x: 0.1, y: 0.1 })).toBe(1);
  expect(o.obstacleAt(show.stage.obstacles, { x: -0.1, y: 0.1 })).toBe(0);
  expect(o.obstacleAt(show.stage.obstacles, { x: -2, y: 0 })).toBe(-1);
  expect(o.removeObstacle(show, 0).stage.obstacles).toEqual([rect]);
  expect(o.removeObstacle(show, 9)).toBe(show);
});

test('limits are written only where they are set, and survive the document', () => {
  const show = newShow('x', 1);
  expect(limitOf(show.stage, 'speed_mps')).toBe(0.27);
  expect(setLimit(show, 'speed_mps', 0.27)).toBe(show);
  const slow = setLimit(setLimit(show, 'speed_mps', 0.1), 'radius_m', 0.05);
  const again = readShow(JSON.parse(JSON.stringify(writeShow(slow))));
  expect(limitOf(again.stage, 'speed_mps')).toBe(0.1);
  expect(again.stage.radius_m).toBe(0.05);
  const written = writeShow(slow) as { stage: { robot: unknown } };
  expect(written.stage.robot).toEqual({ speed_mps: 0.1, radius_m: 0.05 });
});
