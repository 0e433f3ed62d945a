import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  button,
  chosenAre,
  countIs,
  hasKeys,
  onScreen,
  pixels,
  pixelsAre,
  saved,
  smallShow,
  stageStands,
  stored,
  tabTo,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '12');

const item = (page: Page, name: string) => page.getByRole('menuitem', { name });
const frames = (page: Page) => page.getByRole('list', { name: 'Frames' }).locator('li');

/** Place of a pixel on the screen while the whole floor is shown, CSS pixels. */
async function at(page: Page, id: number) {
  const pixel = (await pixels(page))[id];
  return onScreen(page, pixel?.x ?? 0, pixel?.y ?? 0);
}

async function begin(name: string): Promise<Page> {
  const page = await bed.open('edit');
  await uploadText(page, `${name}.json`, smallShow(12));
  await pixelsAre(page, 12);
  return page;
}

test('Space and drag, the middle button and the hand move the view; a tap of Space previews', async () => {
  const page = await begin('view');
  const { x, y } = await at(page, 3);
  const dragBy = async (dx: number, dy: number, mouse: 'left' | 'middle') => {
    const from = await onScreen(page, 0, -0.5);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down({ button: mouse });
    await page.mouse.move(from.x + dx, from.y + dy, { steps: 4 });
    await page.mouse.up({ button: mouse });
  };
  await page.keyboard.down('Space');
  await dragBy(90, 40, 'left');
  await page.keyboard.up('Space');
  await button(page, 'Preview (Space)').waitFor();
  await page.mouse.click(x + 90, y + 40);
  await chosenAre(page, [3]);
  await dragBy(-60, 0, 'middle');
  await chosenAre(page, [3]);
  await button(page, /^Move the view/).click();
  await dragBy(-30, -40, 'left');
  await page.keyboard.press('v');
  await page.mouse.click(x, y);
  await chosenAre(page, [3]);
  await page.keyboard.press('Space');
  await button(page, 'Pause (Space)').waitFor();
  await page.keyboard.press('Space');
  await button(page, 'Preview (Space)').waitFor();
  await page.keyboard.press('0');
  await page.keyboard.press('+');
  await page.keyboard.press('Escape');
  const box = await page.getByTestId('stage').boundingBox();
  if (!box) throw new Error('There is no stage.');
  const [left, top] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.click(left + (x - left) * 1.4, top + (y - top) * 1.4);
  await chosenAre(page, [3]);
});

test('the menu of pixels and of the floor, by the second button and by keyboard', async () => {
  const page = await begin('menu');
  const [one, two] = [await at(page, 1), await at(page, 2)];
  await page.mouse.click(one.x, one.y, { button: 'right' });
  await chosenAre(page, [1]);
  expect(await item(page, 'Group').first().isDisabled()).toBe(true);
  await page.keyboard.press('Escape');
  await page.getByRole('menu').waitFor({ state: 'detached' });
  await chosenAre(page, [1]);
  await page.keyboard.down('Shift');
  await page.mouse.click(two.x, two.y);
  await page.keyboard.up('Shift');
  await page.mouse.click(two.x, two.y, { button: 'right' });
  await item(page, 'Group').first().click();
  await page.getByTestId('chosen').getByText('Group 1 · 2 pixels').waitFor();
  const floor = await onScreen(page, 0, -1);
  await page.mouse.click(floor.x, floor.y, { button: 'right' });
  await chosenAre(page, []);
  await item(page, 'Undo: Group').click();
  await page.mouse.click(one.x, one.y);
  await chosenAre(page, [1]);
  await page.keyboard.press('Shift+F10');
  await hasKeys(page, 'menu');
  const focused = () => page.evaluate(() => document.activeElement?.textContent ?? '');
  for (let i = 0; i < 20 && !(await focused()).startsWith('Select same'); i++)
    await page.keyboard.press('ArrowDown');
  expect(await focused()).toMatch(/^Select same/);
  await page.keyboard.press('Enter');
  await chosenAre(page, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
});

test('a group is chosen and dragged as one, is saved, and lets go of one pixel', async () => {
  const page = await begin('group');
  const [zero, two] = [await at(page, 0), await at(page, 2)];
  await page.mouse.click(zero.x, zero.y);
  await page.keyboard.down('Shift');
  await page.mouse.click(two.x, two.y);
  await page.keyboard.up('Shift');
  await page.keyboard.press('Control+g');
  await page.keyboard.press('Escape');
  await chosenAre(page, []);
  await saved(page);
  const document = await stored(page, 'group');
  expect(document.frames[0]?.pixels.map((p) => p.group ?? '').join()).toBe(
    'Group 1,,Group 1,,,,,,,,,',
  );
  await page.reload();
  await pixelsAre(page, 12);
  await stageStands(page);
  await page.mouse.click(two.x, two.y);
  await chosenAre(page, [0, 2]);
  await page.mouse.dblclick(two.x, two.y);
  await chosenAre(page, [2]);
  await page.keyboard.press('Escape');
  await page.keyboard.down('Alt');
  await page.mouse.click(zero.x, zero.y);
  await page.keyboard.up('Alt');
  await chosenAre(page, [0]);
  await page.keyboard.press('Escape');
  await page.mouse.click(zero.x, zero.y);
  await page.keyboard.press('Control+Shift+g');
  await page.mouse.click(two.x, two.y);
  await chosenAre(page, [2]);
});

test('the history leads back and forth to any state, by pointer and by keyboard', async () => {
  const page = await begin('history');
  const start = await pixels(page);
  await page.keyboard.press('Control+a');
  for (const key of ['ArrowDown', 'ArrowDown', 'ArrowLeft']) await page.keyboard.press(key);
  await button(page, 'Colour pink #ff2f92').click();
  const end = await pixels(page);
  await button(page, 'History').click();
  const states = page.getByRole('menuitemradio');
  await countIs(states, 5);
  expect(await states.allTextContents()).toEqual([
    ...['Colour', 'Nudge', 'Nudge', 'Nudge'].map((name) => `${name}frame 1`),
    'As it was opened',
  ]);
  await states.last().click();
  const places = (list: { x: number; y: number; color: string }[]) =>
    list.map((p) => [p.x, p.y, p.color]);
  await eventually(
    () => pixels(page),
    (now) => places(now).join() === places(start).join(),
    'it is as it was opened',
  );
  // The list stays open, so that states can be compared.
  await page.keyboard.press('Escape');
  await states.first().waitFor({ state: 'detached' });
  await tabTo(page, 'button', 'History');
  await page.keyboard.press('Enter');
  // Keys that are pressed before the menu has the focus are lost.
  await page.locator('[role=menuitemradio]:focus, [role=menu]:focus').waitFor();
  await page.keyboard.press('Home');
  await page.locator('[role=menuitemradio]:focus').first().waitFor();
  await page.keyboard.press('Enter');
  await eventually(
    () => pixels(page),
    (now) => places(now).join() === places(end).join(),
    'all is done again',
  );
});

test('several frames are chosen with Ctrl and Shift: coloured, timed, copied, moved and deleted together', async () => {
  const page = await begin('several');
  await page.keyboard.press('Control+d');
  await page.keyboard.press('Control+d');
  await countIs(frames(page), 4);
  const card = (index: number) => frames(page).nth(index).getByRole('button');
  await card(0).click();
  await card(2).click({ modifiers: ['Control'] });
  await button(page, 'Colour pink #ff2f92').click();
  await page.getByRole('tab', { name: 'Frame' }).click();
  await page.getByText('2 frames', { exact: true }).waitFor();
  const air = page.getByRole('textbox', { name: 'Air time (s)' });
  await air.fill('2.5');
  await air.press('Enter');
  await saved(page);
  const document = await stored(page, 'several');
  expect(document.frames.map((f) => f.air_time_s)).toEqual([2.5, 0.3, 2.5, 0.3]);
  expect(document.frames.map((f) => f.pixels[5]?.color === '#ff2f92')).toEqual([
    true,
    false,
    true,
    false,
  ]);
  // A click with Ctrl on a chosen frame takes it out of the choice.
  await card(2).click({ modifiers: ['Control'] });
  await page.getByText('Frame 1', { exact: true }).waitFor();
  await page.keyboard.press('Shift+PageDown');
  await page.getByText('2 frames', { exact: true }).waitFor();
  await page.keyboard.press('Alt+PageDown');
  await page.keyboard.press('Control+Delete');
  await countIs(frames(page), 2);
  await saved(page);
});

test('pixels off the floor are put back onto it with one click', async () => {
  const page = await begin('off');
  await page.keyboard.press('Control+a');
  for (let i = 0; i < 8; i++) await page.keyboard.press('Shift+ArrowUp');
  await page.getByText('12 pixels are off the floor', { exact: false }).waitFor();
  await button(page, 'Fit to floor').click();
  await eventually(
    () => pixels(page),
    (list) => list.every((p) => Math.abs(p.x) <= 1.463 + 1e-6 && Math.abs(p.y) <= 1.463 + 1e-6),
    'all pixels are on the floor',
  );
  await page.keyboard.press('Control+z');
  await page.getByText('12 pixels are off the floor', { exact: false }).waitFor();
});

test('a click fills what lies together in one colour, and a drag paints what it passes', async () => {
  const page = await begin('fill');
  const violet = async () =>
    (await pixels(page)).flatMap(({ color }, id) => (color === 'b14cff' ? [id] : []));
  await page.keyboard.press('f');
  await button(page, 'Colour violet #b14cff').click();
  expect(await violet(), 'only the colour is chosen').toEqual([]);
  const [from, to] = [await at(page, 2), await at(page, 4)];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 12 });
  await page.mouse.up();
  expect(await violet()).toEqual([2, 3, 4]);
  const { x, y } = await at(page, 8);
  await page.mouse.click(x, y);
  expect(await violet()).toEqual([2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
  await page.keyboard.press('Control+z');
  expect(await violet()).toEqual([2, 3, 4]);
});
