import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { eventually } from './harness';
import {
  button,
  countIs,
  drag,
  makeShape,
  makeWords,
  onScreen,
  openShow,
  phaseIs,
  pixels,
  pixelsAre,
  saved,
  stored,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '12');

const frames = (page: Page) => page.getByRole('list', { name: 'Frames' }).locator('li');

/** Begins an empty show in the editor; answers its name in the library. */
async function begin(page: Page): Promise<string> {
  await page.getByTestId('open-library').click();
  await button(page, 'New show').click();
  await button(page, 'Empty show').click();
  await page.getByTestId('stage').waitFor();
  const title = page.getByTestId('open-library').getByText(/^Untitled/);
  await title.waitFor();
  await countIs(frames(page), 1);
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  return (await title.textContent()) ?? '';
}

describe('the editor', () => {
  test('three frames from nothing, saved, and played', async () => {
    const page = await bed.open('edit');
    const name = await begin(page);
    await makeShape(page, 'Heart');
    await button(page, /^Add a frame/).click();
    await makeShape(page, 'Circle');
    await button(page, /^Add a frame/).click();
    await makeWords(page, 'HI');
    await button(page, 'All').click();
    await button(page, 'Colour pink #ff2f92').click();
    await saved(page);
    const document = await stored(page, name);
    expect(document.frames).toHaveLength(3);
    expect(document.frames[2]?.pixels.every((p) => p.color === '#ff2f92')).toBe(true);
    await button(page, 'Run on robots').click();
    await page.getByText(/frame 2 of 3/).waitFor();
    await page.keyboard.press('Escape');
    await phaseIs(page, 'ready');
  });

  test('choosing, dragging, undoing and redoing by hand', async () => {
    const page = await bed.open('edit');
    await begin(page);
    const start = await pixels(page);
    const first = start[0];
    if (!first) throw new Error('There are no pixels.');
    await drag(page, [first.x, first.y], [0.2, 0.1]);
    const moved = await pixels(page);
    expect(Math.hypot((moved[0]?.x ?? 9) - 0.2, (moved[0]?.y ?? 9) - 0.1)).toBeLessThan(0.06);
    await drag(page, [0.05, -0.1], [0.4, 0.4]);
    expect((await pixels(page)).filter((p) => p.chosen)).toHaveLength(1);
    for (let i = 0; i < 40; i++) await page.keyboard.press('ArrowRight');
    const end = await pixels(page);
    expect((end[0]?.x ?? 0) - (moved[0]?.x ?? 0)).toBeCloseTo(0.4, 3);
    for (let i = 0; i < 41; i++) await page.keyboard.press('Control+z');
    expect((await pixels(page)).map((p) => [p.x, p.y])).toEqual(start.map((p) => [p.x, p.y]));
    for (let i = 0; i < 41; i++) await page.keyboard.press('Control+Shift+z');
    expect((await pixels(page)).map((p) => [p.x, p.y])).toEqual(end.map((p) => [p.x, p.y]));
    const at = await onScreen(page, -1, -1);
    await page.mouse.click(at.x, at.y);
    expect((await pixels(page)).some((p) => p.chosen)).toBe(false);
    await saved(page);
  });

  test('by keyboard only', async () => {
    const page = await bed.open('edit');
    const name = await begin(page);
    await page.keyboard.press(']');
    await page.keyboard.press(']');
    expect((await pixels(page)).findIndex((p) => p.chosen)).toBe(1);
    const before = (await pixels(page))[1]?.y ?? 0;
    await page.keyboard.press('Shift+ArrowDown');
    await page.keyboard.press('Alt+ArrowDown');
    expect(before - ((await pixels(page))[1]?.y ?? 0)).toBeCloseTo(0.101, 3);
    await page.keyboard.press('Control+Enter');
    await page.keyboard.press('Control+d');
    await countIs(frames(page), 3);
    await page.keyboard.press('Control+Delete');
    await page.keyboard.press('Alt+PageUp');
    await countIs(frames(page), 2);
    await saved(page);
    expect((await stored(page, name)).frames.map((f) => f.name)).toEqual(['Frame 2', 'Start']);
  });

  test('an edited example becomes a copy, says so, and is there after reloading and a restart', async () => {
    const page = await bed.open('edit');
    await openShow(page, 'hello');
    const second = await bed.open('edit');
    await pixelsAre(page);
    const before = await stored(page, 'hello');
    await button(page, 'All').click();
    await button(page, 'Colour cyan #00e0c8').click();
    await page.getByText('Examples are read-only. Saved as "hello 2".').waitFor();
    await page.getByTestId('open-library').getByText('hello 2', { exact: true }).waitFor();
    // The same editor goes on: what was done can be undone, and every change goes to the copy.
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+Shift+z');
    await saved(page);
    expect(await stored(page, 'hello')).toEqual(before);
    const all = (p: { color: string }[]) => p.length > 0 && p.every((x) => x.color === '00e0c8');
    expect(
      (await pixels(second)).some((p) => all([p])),
      'no editor moves by itself',
    ).toBe(false);
    await button(second, 'Edit hello 2').click();
    await eventually(() => pixels(second), all, 'the second browser sees it');
    await page.reload();
    await eventually(() => pixels(page), all, 'it is there after reloading');
    await bed.server.kill();
    await bed.server.restart();
    await page.reload();
    await eventually(() => pixels(page), all, 'it is there after a restart');
    await page.getByTestId('open-library').getByText('hello 2', { exact: true }).waitFor();
    expect((await stored(page, 'hello 2')).frames).toHaveLength(before.frames.length);
  });

  test('the server dies in the middle of an edit, and nothing is lost', async () => {
    const page = await bed.open('edit');
    const name = await begin(page);
    await bed.server.kill();
    await button(page, 'All').click();
    await button(page, 'Colour violet #b14cff').click();
    await page.getByText('Not saved yet').waitFor();
    await bed.server.restart();
    await saved(page);
    const document = await stored(page, name);
    expect(document.frames[0]?.pixels.every((p) => p.color === '#b14cff')).toBe(true);
  });
});
