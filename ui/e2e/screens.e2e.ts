import { expect, test } from 'vitest';
import {
  button,
  openShow,
  phaseIs,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('a show opened on another screen leaves this editor alone, and its address is a link', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'mine.json', smallShow(6));
  await pixelsAre(page, 6);
  expect(page.url()).toMatch(/#\/edit\/mine$/);
  const second = await bed.open('edit');
  await openShow(second, 'countdown');
  await page.getByText(/You edit mine, and countdown is open/).waitFor();
  await button(page, 'All').click();
  await button(page, 'Colour violet #b14cff').click();
  await saved(page);
  const { frames } = await stored(page, 'mine');
  expect(frames[0]?.pixels.every((p) => p.color === '#b14cff')).toBe(true);
  expect(await second.getByTestId('show-name').textContent()).toBe('countdown');

  // The link leads another screen to the same show; the server's open show stays open.
  await second.goto(page.url());
  await pixelsAre(second, 6);
  expect(await second.getByTestId('show-name').textContent()).toBe('mine');
  await button(second, 'Run on robots').click();
  await phaseIs(second, 'playing');
  await second.getByTestId('stop-all').click();
  await page.getByText(/You edit mine/).waitFor({ state: 'hidden' });
});

test('an address of a show that is not in the library says so and leads to the open one', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'here.json', smallShow(6));
  await page.evaluate(() => {
    location.hash = '#/edit/gone%20show';
  });
  await page.getByRole('heading', { name: 'This show is not here' }).waitFor();
  await button(page, 'Edit the open show').click();
  await pixelsAre(page, 6);
  expect(page.url()).toMatch(/#\/edit\/here$/);
});
