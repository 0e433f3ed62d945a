import { expect, test } from 'vitest';
import {
  button,
  countIs,
  openShow,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('an earlier save is looked at and restored in two clicks, and restoring loses nothing', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'states.json', smallShow(6));
  await pixelsAre(page, 6);
  const colours = ['violet #b14cff', 'pink #ff2f92', 'cyan #00e0c8'];
  for (const colour of colours) {
    await button(page, 'All').click();
    await button(page, `Colour ${colour}`).click();
    await page.locator('[data-testid=save][data-save=waiting]').waitFor();
    await saved(page);
  }
  const colour = async () => (await stored(page, 'states')).frames[0]?.pixels[0]?.color;
  expect(await colour()).toBe('#00e0c8');
  // The first click shows all states with their pictures.
  await button(page, 'Earlier saves').click();
  const states = page.getByRole('list', { name: 'Saved states' });
  const rows = states.locator('> li');
  await countIs(rows, 4);
  await countIs(states.locator('canvas'), 4);
  // A state can be expanded to show all its frames.
  await rows.nth(2).getByRole('button', { expanded: false }).click();
  await countIs(page.getByRole('list', { name: 'Frames of the state' }).locator('li'), 2);
  // The second click restores.
  await rows
    .nth(2)
    .getByRole('button', { name: /^Restore/ })
    .click();
  await page.getByText(/^states is as it was saved on/).waitFor();
  await saved(page);
  expect(await colour()).toBe('#b14cff');
  await button(page, 'Earlier saves').click();
  await countIs(rows, 5);
  await page.keyboard.press('Escape');
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  await page.keyboard.press('Control+z');
  await saved(page);
  expect(await colour(), 'it is undone as any change').toBe('#00e0c8');
});

test('a show that is not open is restored from the library, under its new name too', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'renamed.json', smallShow(6));
  await pixelsAre(page, 6);
  await button(page, 'All').click();
  await button(page, 'Colour pink #ff2f92').click();
  await page.locator('[data-testid=save][data-save=waiting]').waitFor();
  await saved(page);
  await openShow(page, 'countdown');
  await page.getByTestId('open-library').click();
  const menu = async (name: string, item: string) => {
    await button(page, `What to do with ${name}`).click();
    await page.getByRole('menuitem', { name: item, exact: true }).click();
  };
  await menu('renamed', 'Rename…');
  await page.getByRole('dialog').last().getByLabel('Name', { exact: true }).fill('moved');
  await button(page, 'Save').click();
  await button(page, 'What to do with moved').waitFor();
  await menu('moved', 'Earlier saves…');
  const rows = page.getByRole('list', { name: 'Saved states' }).locator('> li');
  await countIs(rows, 2);
  await rows
    .nth(1)
    .getByRole('button', { name: /^Restore/ })
    .click();
  await page.getByText(/^moved is as it was saved on/).waitFor();
  expect((await stored(page, 'moved')).frames[0]?.pixels[0]?.color).toBe('#ff8c00');
});
