import { expect, test } from 'vitest';
import { button, countIs, phaseIs, saved, smallShow, stored, tabTo, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('Space does what its tip says after a click, and presses a button that was tabbed to', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'space.json', smallShow(6, 20));
  const frames = page.getByRole('list', { name: 'Frames' }).locator('li');
  const preview = page.getByRole('button', { name: 'Preview (Space)' });
  await button(page, /^Add a frame/).click();
  await countIs(frames, 3);
  await page.keyboard.press('Space');
  const pause = page.getByRole('button', { name: 'Pause (Space)' });
  await pause.waitFor();
  await page.keyboard.press('Space');
  await preview.waitFor();
  expect(await frames.count()).toBe(3);
  // After Tab, keys belong to the focused button.
  await page.keyboard.press('Shift+Tab');
  await tabTo(page, 'button', 'Add a frame (Ctrl Enter)');
  await page.keyboard.press('Space');
  await countIs(frames, 4);
  await page.keyboard.press('Enter');
  await countIs(frames, 5);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await countIs(frames, 2);
  await saved(page);

  await page.goto(`${bed.server.url}/#/live`);
  await phaseIs(page, 'ready');
  const loop = page.getByRole('button', { name: 'Loop (L)' });
  await loop.click();
  await page.locator('[aria-label="Loop (L)"][aria-pressed=true]').waitFor();
  await page.keyboard.press('Space');
  await phaseIs(page, 'playing');
  await page.keyboard.press('Space');
  await phaseIs(page, 'paused');
  expect(await loop.getAttribute('aria-pressed')).toBe('true');
  // A tooltip that is shown does not take Escape for itself.
  await loop.hover();
  await page.getByRole('tooltip', { name: 'Loop (L)' }).waitFor();
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
  await page.keyboard.press('Home');
  await page.keyboard.press('Space');
  await phaseIs(page, 'playing');
  await page.getByTestId('stop-all').hover();
  await page.getByRole('tooltip', { name: /^Every robot stops/ }).waitFor();
  await page.keyboard.press('Shift+Escape');
  await phaseIs(page, 'ready');
  // In a dialog, keys belong to the focused element.
  await page.keyboard.press('c');
  const dialog = page.getByRole('dialog');
  await dialog.waitFor();
  await tabTo(page, 'button', 'Not now');
  await page.keyboard.press('Space');
  await dialog.waitFor({ state: 'hidden' });
  expect(await page.getByTestId('phase').getAttribute('data-phase')).toBe('ready');
});

test('numbers: a comma is a point, and what cannot be is refused at the field', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'numbers.json', smallShow(6));
  await page.getByRole('tab', { name: 'Frame' }).click();
  const air = page.getByLabel('Air time (s)');
  const type = async (text: string) => {
    await air.fill(text);
    await air.press('Enter');
  };
  const kept = async () => {
    await saved(page);
    return (await stored(page, 'numbers')).frames[0]?.air_time_s;
  };
  await type('0,5');
  expect(await kept()).toBe(0.5);
  await type('-3');
  await page.getByRole('alert').getByText('At least 0 s. It is still 0.5 s.').waitFor();
  await type('99999');
  await page.getByRole('alert').getByText('At most 3600 s. It is still 0.5 s.').waitFor();
  expect(await kept()).toBe(0.5);
  await air.press('Escape');
  expect(await air.inputValue()).toBe('0.5');
  await page.getByRole('tab', { name: /^Show/ }).click();
  const many = page.getByLabel('Number of robots');
  await many.fill('99999');
  await many.press('Tab');
  await page.getByRole('alert').getByText('At most 2000. It is still 6.').waitFor();
  expect((await stored(page, 'numbers')).frames[0]?.pixels).toHaveLength(6);
});
