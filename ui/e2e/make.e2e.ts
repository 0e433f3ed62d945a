import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import { beginShow, button, makeWords, pixels, saved, stored, tabTo, useMade } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '30');

const verdict = (page: Page) => page.getByTestId('verdict');
const words = (page: Page) => page.getByRole('textbox', { name: 'Words' });

/** The stored sources of the first frame. */
const sources = async (page: Page, name: string) =>
  ((await stored(page, name)).frames[0] as { sources?: { settings: unknown; moved?: number[] }[] })
    .sources;

test('a word is shown while it is typed, used, undone, saved, and changed after reloading', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  const before = await pixels(page);
  await button(page, 'Make…').click();
  await page.keyboard.type('HI');
  await verdict(page).getByText('Readable').waitFor();
  await verdict(page)
    .getByText(/^30 robots/)
    .waitFor();
  await verdict(page)
    .getByText(/^Collision-free drive of \d/)
    .waitFor();
  expect(await pixels(page), 'the frame is as it was').toEqual(before);
  await useMade(page);
  const made = await pixels(page);
  expect(made).toHaveLength(30);
  expect(made).not.toEqual(before);
  await page.keyboard.press('Control+z');
  expect(await pixels(page)).toEqual(before);
  await page.keyboard.press('Control+Shift+z');
  expect(await pixels(page)).toEqual(made);
  await saved(page);
  await page.reload();
  await page.getByText('Made from the words “HI”').waitFor();
  await button(page, 'Change…').click();
  expect(await words(page).inputValue()).toBe('HI');
  await words(page).fill('NO');
  await useMade(page);
  await saved(page);
  expect(await sources(page, name)).toMatchObject([{ settings: { text: 'NO' } }]);
});

test('by keyboard only: a shape, another one, and Escape leaves all as it was', async () => {
  const page = await bed.open('live');
  await beginShow(page);
  const press = (key: string) => page.keyboard.press(key);
  const before = await pixels(page);
  await tabTo(page, 'button', 'Make…');
  await press('Enter');
  await page.keyboard.type('HELLO');
  await verdict(page)
    .getByText(/^30 robots/)
    .waitFor();
  await press('Escape');
  await words(page).waitFor({ state: 'detached' });
  expect(await pixels(page)).toEqual(before);
  await press('s');
  await tabTo(page, 'button', 'Star');
  await press('Enter');
  await tabTo(page, 'slider', 'Turn');
  for (let i = 0; i < 10; i++) await press('ArrowRight');
  await tabTo(page, 'button', 'Use');
  await press('Enter');
  await page.getByText('Made from the shape star').waitFor();
  expect(await pixels(page)).toHaveLength(30);
  await press('Enter');
  await page.getByText('10°', { exact: true }).waitFor();
});

test('too few robots are told how many would do; what cannot be made says why', async () => {
  const page = await bed.open('live');
  await beginShow(page);
  await button(page, 'Make…').click();
  await words(page).fill('HELLO WORLD');
  await verdict(page)
    .getByText(/Hard to read: \d+ robots would do/)
    .waitFor();
  await page.getByText('Files', { exact: true }).click();
  const drawing = (name: string, text: string) => ({
    name,
    mimeType: 'image/svg+xml',
    buffer: Buffer.from(text),
  });
  const file = page.locator('input[type=file]');
  await file.setInputFiles(drawing('broken.svg', '%PDF-1.7'));
  await page
    .getByRole('alert')
    .getByText(/cannot be drawn/)
    .waitFor();
  const heart = '<path d="M0 3C-6 -3 -3 -6 0 -3C3 -6 6 -3 0 3" fill="#ff2f92"/>';
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-6 -6 12 12">${heart}</svg>`;
  await file.setInputFiles(drawing('heart.svg', svg));
  await verdict(page)
    .getByText(/^30 robots/)
    .waitFor();
  await useMade(page);
  await page.getByText('Made from the file heart.svg').waitFor();
  await saved(page);
  await page.reload();
  await button(page, 'Change…').click();
  await verdict(page)
    .getByText(/^30 robots/)
    .waitFor();
});

test('a pixel that is moved by hand stays when the word changes', async () => {
  const page = await bed.open('live');
  const name = await beginShow(page);
  await makeWords(page, 'HI');
  await page.keyboard.press(']');
  await page.keyboard.press('Shift+ArrowUp');
  const moved = (await pixels(page))[0];
  await saved(page);
  expect((await sources(page, name))?.[0]?.moved).toEqual([0]);
  await button(page, 'Change…').click();
  await page.getByText('1 pixel was moved by hand and will stay.').waitFor();
  await words(page).fill('OH');
  await useMade(page);
  const after = await eventually(
    () => pixels(page),
    (now) => now.length === 30,
    'there are 30 pixels',
  );
  expect(after[0]).toMatchObject({ x: moved?.x, y: moved?.y });
});
