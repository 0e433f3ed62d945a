import { expect, test } from 'vitest';
import {
  button,
  countIs,
  phaseIs,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('a frame waits for GO: set in the editor, given on the live page by key and by button', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'curtain.json', smallShow(6));
  await pixelsAre(page, 6);
  await page.getByRole('tab', { name: 'Frame' }).click();
  await page.getByRole('checkbox', { name: 'Wait for GO after this' }).click();
  const name = page.getByRole('textbox', { name: 'Cue' });
  await name.fill('Curtain');
  await name.press('Enter');
  const marks = page.getByRole('list', { name: 'Frames' }).getByTitle('Waits for GO');
  await countIs(marks, 1);
  await saved(page);
  const { cues } = (await stored(page, 'curtain')) as unknown as { cues: unknown };
  expect(cues).toEqual([{ name: 'Curtain', frame: 'f1' }]);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await countIs(marks, 0);
  await page.keyboard.press('Control+Shift+z');
  await page.keyboard.press('Control+Shift+z');
  await countIs(marks, 1);

  for (const give of [
    () => page.keyboard.press('Enter'),
    () => button(page, 'GO (Enter)').click(),
  ]) {
    if (page.url().includes('#/edit')) await button(page, 'Run on robots').click();
    else await button(page, 'Play').click();
    const note = page.getByTestId('go-note');
    await note.getByText('Curtain').waitFor();
    await note.getByText('Next: frame 2, Two').waitFor();
    await page.getByText('Waiting for GO, frame 1 of 2').waitFor();
    await phaseIs(page, 'playing');
    await give();
    await note.waitFor({ state: 'hidden' });
    await page.getByText('Playing frame 2 of 2').waitFor();
    await phaseIs(page, 'ready');
  }
});
