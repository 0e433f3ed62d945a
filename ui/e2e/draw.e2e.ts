import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  beginShow,
  button,
  drag,
  onScreen,
  pixels,
  pixelsAre,
  saved,
  stored,
  tabTo,
  useMade,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '30');

interface Settings {
  shape?: string;
  size_m?: number;
  turn?: number;
  center?: [[number, number]];
  aspect?: number;
  points?: [number, number][];
  closed?: boolean;
}

/** The stored settings of the first frame's source. */
async function settings(page: Page, name: string): Promise<Settings> {
  await saved(page);
  const [frame] = (await stored(page, name)).frames as unknown as {
    sources: { settings: Settings }[];
  }[];
  return frame?.sources[0]?.settings ?? {};
}

const field = (page: Page, name: RegExp) => page.getByRole('textbox', { name });
const made = (page: Page) =>
  page
    .getByTestId('verdict')
    .getByText(/^30 robots/)
    .waitFor();
const click = async (page: Page, x: number, y: number) => {
  const at = await onScreen(page, x, y);
  await page.mouse.click(at.x, at.y);
};
const box = async (page: Page) => {
  const list = await pixels(page);
  const [xs, ys] = [list.map((p) => p.x), list.map((p) => p.y)];
  return {
    minX: Math.min(...xs),
    maxX: Math.max(...xs),
    minY: Math.min(...ys),
    maxY: Math.max(...ys),
  };
};

test('a shape is moved, scaled and turned on the stage, and by its fields', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  await page.keyboard.press('s');
  await button(page, 'Rectangle').click();
  await field(page, /^Middle x/).fill('0.2');
  await field(page, /^Middle y/).fill('0.1');
  await field(page, /^Middle y/).press('Enter');
  await made(page);
  await drag(page, [0.2, 0.1], [0.5, -0.1]);
  await eventually(
    () => field(page, /^Middle x/).inputValue(),
    (x) => Math.abs(Number(x) - 0.5) < 0.02,
    'the picture was dragged to the right',
  );
  // Escape takes a drag back, and leaves the panel open.
  const from = await onScreen(page, 0.5, -0.1);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 80, from.y, { steps: 4 });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await eventually(
    () => field(page, /^Middle x/).inputValue(),
    (x) => Math.abs(Number(x) - 0.5) < 0.02,
    'the drag was taken back',
  );
  await useMade(page);
  const first = await settings(page, name);
  expect(first.center?.[0][0]).toBeCloseTo(0.5, 1);
  const placed = await box(page);
  const size = placed.maxX - placed.minX;
  expect((placed.minX + placed.maxX) / 2).toBeCloseTo(0.5, 1);

  // A corner is dragged outward by a tenth of the picture on either side: the opposite one stays.
  await button(page, 'Change…').click();
  await made(page);
  const gap = 16 / ((await onScreen(page, 1, 0)).x - (await onScreen(page, 0, 0)).x);
  const corner: [number, number] = [placed.minX - gap, placed.maxY + gap];
  await drag(page, corner, [corner[0] - size * 0.2, corner[1] + size * 0.2]);
  await useMade(page);
  const second = await settings(page, name);
  const grown = await box(page);
  expect(second.size_m ?? 0).toBeGreaterThan(size * 1.1);
  expect(grown.maxX).toBeCloseTo(placed.maxX, 1);
  expect(grown.minY).toBeCloseTo(placed.minY, 1);

  // A side is dragged inward: the opposite side and the height stay.
  await button(page, 'Change…').click();
  await made(page);
  const high = grown.maxY - grown.minY;
  const side: [number, number] = [grown.minX - gap, (grown.minY + grown.maxY) / 2];
  await drag(page, side, [side[0] + high / 2, side[1]]);
  await useMade(page);
  const narrow = await box(page);
  expect((await settings(page, name)).aspect).toBeCloseTo(0.5, 1);
  expect(narrow.maxX).toBeCloseTo(grown.maxX, 1);
  expect(narrow.maxY - narrow.minY).toBeCloseTo(high, 1);

  // The knob above the picture turns it, with Shift in steps of 15°.
  await button(page, 'Change…').click();
  await made(page);
  const middle = { x: (narrow.minX + narrow.maxX) / 2, y: (narrow.minY + narrow.maxY) / 2 };
  const knob: [number, number] = [middle.x, narrow.maxY + gap * (42 / 16)];
  const arm = knob[1] - middle.y;
  await page.keyboard.down('Shift');
  await drag(page, knob, [middle.x - arm * 0.68, middle.y + arm * 0.73]);
  await page.keyboard.up('Shift');
  await page.getByText('45°', { exact: true }).waitFor();
  await useMade(page);
  expect((await settings(page, name)).turn).toBeCloseTo(Math.PI / 4, 3);
  expect(await pixels(page)).toHaveLength(30);
});

test('a curve is drawn with clicks; its points are dragged, added and removed', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  await button(page, 'Draw a line (B)').click();
  await button(page, 'Curve').click();
  await page.getByText('No points yet').waitFor();
  const places: [number, number][] = [
    [-1, -0.4],
    [-0.3, 0.5],
    [0.4, -0.3],
    [1, 0.4],
  ];
  for (const [x, y] of places) await click(page, x, y);
  await page.keyboard.press('Enter');
  await page.getByText('Point 4 of 4').waitFor();
  await made(page);
  await useMade(page);
  const drawn = await settings(page, name);
  expect(drawn.points).toHaveLength(4);
  expect(drawn.points?.[1]?.[0]).toBeCloseTo(-0.3, 1);
  const list = await pixels(page);
  expect(list).toHaveLength(30);
  const nearest = (x: number, y: number) =>
    Math.min(...list.map((p) => Math.hypot(p.x - x, p.y - y)));
  expect(nearest(...(drawn.points?.[0] ?? [9, 9]))).toBeLessThan(0.02);
  expect(nearest(...(drawn.points?.[3] ?? [9, 9]))).toBeLessThan(0.02);

  await button(page, 'Change…').click();
  await made(page);
  await drag(page, [1, 0.4], [1.1, 0.9]);
  await drag(page, [0.05, 0.1], [0, 0]);
  await page.getByText('Point 3 of 5').waitFor();
  const gone = await onScreen(page, -0.3, 0.5);
  await page.mouse.dblclick(gone.x, gone.y);
  await page.getByText('4 points').waitFor();
  await useMade(page);
  const changed = await settings(page, name);
  expect(changed.points?.map(([x]) => Math.round(x * 10) / 10 + 0)).toEqual([-1, 0, 0.4, 1.1]);
  expect(await pixels(page)).toHaveLength(30);
});

test('a line with corners is closed on its first point, and a stroke is drawn by hand', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  await page.keyboard.press('b');
  await button(page, 'Line with corners').click();
  for (const [x, y] of [
    [-0.8, -0.6],
    [0.8, -0.6],
    [0, 0.8],
    [-0.8, -0.6],
  ] as const)
    await click(page, x, y);
  await eventually(
    () => page.getByRole('checkbox', { name: 'Closed' }).isChecked(),
    (closed) => closed,
    'the line is closed',
  );
  await useMade(page);
  expect(await settings(page, name)).toMatchObject({ shape: 'polyline', closed: true });
  expect((await settings(page, name)).points).toHaveLength(3);

  await button(page, 'Change…').click();
  await button(page, 'Drawn by hand').click();
  await button(page, 'Draw again').click();
  await page.getByText('No points yet').waitFor();
  const start = await onScreen(page, -1, 0);
  await page.mouse.move(start.x, start.y);
  await page.mouse.down();
  for (let i = 1; i <= 40; i++) {
    const at = await onScreen(page, -1 + i * 0.05, 0.5 * Math.sin(i * 0.16));
    await page.mouse.move(at.x, at.y);
  }
  await page.mouse.up();
  await useMade(page);
  const stroke = await settings(page, name);
  expect(stroke.shape).toBe('freehand');
  expect(stroke.points?.length ?? 0).toBeGreaterThan(5);
  expect(stroke.points?.length ?? 99).toBeLessThan(40);
  expect(await pixels(page)).toHaveLength(30);
});

test('a line with corners by keyboard only', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  const press = async (...keys: string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  await press('b');
  await tabTo(page, 'button', 'Line with corners');
  await press('Enter');
  await tabTo(page, 'button', 'Add a point');
  await press('Enter', 'Enter', 'Enter');
  await page.getByText('Point 3 of 3').waitFor();
  await press('Shift+ArrowUp', 'Shift+ArrowUp', 'Shift+ArrowUp');
  await press('[', '[', 'Shift+ArrowLeft', 'Shift+ArrowDown');
  await page.getByText('Point 1 of 3').waitFor();
  await press(']', 'Delete');
  await page.getByText('Point 2 of 2').waitFor();
  await tabTo(page, 'button', 'Use');
  await press('Enter');
  await button(page, 'Change…').waitFor();
  expect((await settings(page, name)).points).toEqual([
    [-0.3, -0.1],
    [0.2, 0.3],
  ]);
  expect(await pixels(page)).toHaveLength(30);
});

test('a shape with a name is used in another show, after reloading', async () => {
  const page = await bed.open('live');
  await beginShow(page);
  await page.keyboard.press('b');
  await button(page, 'Curve').click();
  for (const [x, y] of [
    [-1, -0.4],
    [0, 0.5],
    [1, -0.3],
  ] as const)
    await click(page, x, y);
  await page.keyboard.press('Enter');
  await field(page, /^Keep this as$/).fill('Hill');
  await field(page, /^Keep this as$/).press('Enter');
  await button(page, 'Hill').waitFor();
  await button(page, 'Cancel').click();
  await page.reload();
  await pixelsAre(page, 30);
  const name = await beginShow(page);
  await page.keyboard.press('s');
  await button(page, 'Hill').click();
  await page.getByText('3 points').waitFor();
  await useMade(page);
  expect(await settings(page, name)).toMatchObject({ shape: 'curve', size_m: 2 });
  expect((await settings(page, name)).points).toHaveLength(3);
  await page.keyboard.press('s');
  await button(page, 'Remove own shape Hill').click();
  await button(page, 'Hill').waitFor({ state: 'detached' });
});
