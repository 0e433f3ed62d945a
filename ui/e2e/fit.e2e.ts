import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  beginEmpty,
  button,
  makeWords,
  pixels,
  pixelsAre,
  saved,
  stored,
  uploadText,
  smallShow,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '18');

test('before Play, a show for more robots is fitted to those that are here, and undone', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'many.json', smallShow(30));
  await page
    .getByTestId('fit-note')
    .getByText('The show has 30 pixels, and 18 robots are here.')
    .waitFor();
  await button(page, 'Fit to 18 robots…').click();
  const dialog = page.getByRole('dialog', { name: 'Fit to 18 robots' });
  await dialog.getByText('30 → 18').first().waitFor();
  await dialog.getByRole('button', { name: 'Fit to 18 robots' }).click();
  const counts = async () => (await stored(page, 'many')).frames.map((f) => f.pixels.length);
  await eventually(counts, (now) => now.every((n) => n === 18), 'every frame has 18 pixels');
  await page.getByTestId('fit-note').waitFor({ state: 'detached' });
  await button(page, 'Undo').click();
  await eventually(counts, (now) => now.every((n) => n === 30), 'every frame has 30 pixels again');
});

test('in the editor, a word flows anew for the robots that are here, as one step of the history', async () => {
  const page = await bed.open('live');
  await beginEmpty(page);
  await pixelsAre(page, 18);
  await page.getByRole('tab', { name: 'Show' }).click();
  const number = page.getByRole('textbox', { name: 'Number of robots' });
  await number.fill('40');
  await number.press('Enter');
  await pixelsAre(page, 40);
  await makeWords(page, 'HI');
  const forty = await pixels(page);
  await page.getByRole('tab', { name: 'Show' }).click();
  await button(page, 'Fit to the 18 here…').click();
  await page.getByRole('dialog').getByText('40 → 18').waitFor();
  await page.getByRole('dialog').getByRole('button', { name: 'Fit to 18 robots' }).click();
  await pixelsAre(page, 18);
  await page.getByText('Made from the words “HI”').waitFor();
  const name = (await page.getByTestId('show-name').textContent()) ?? '';
  await saved(page);
  const [frame] = (await stored(page, name)).frames as { pixels: { part?: string }[] }[];
  expect(new Set(frame?.pixels.map((pixel) => pixel.part)).size).toBe(2);
  await page.keyboard.press('Control+z');
  expect(await pixels(page)).toEqual(forty);
});
