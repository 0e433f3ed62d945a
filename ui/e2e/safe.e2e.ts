import { expect, test } from 'vitest';
import { button, openShow, pixelsAre, saved, smallShow, stored, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('server and page both die in the middle of an edit, and nothing is lost', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'dying.json', smallShow(6));
  await bed.server.kill();
  await button(page, 'All').click();
  await button(page, 'Colour violet #b14cff').click();
  await page.getByText('Not saved yet').waitFor();
  await page.goto('about:blank');
  await bed.server.restart();
  await page.goto(`${bed.server.url}/#/live`);
  await page.getByText(/Changes of dying.* never reached the server/).waitFor();
  await page.getByRole('button', { name: 'Put them back' }).click();
  await saved(page);
  const document = await stored(page, 'dying');
  expect(document.frames[0]?.pixels.every((p) => p.color === '#b14cff')).toBe(true);
});

test('two browsers change one show at once: neither overwrites the other silently', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'shared.json', smallShow(6));
  const second = await bed.open('edit');
  await pixelsAre(second, 6);
  await second.context().setOffline(true);
  for (const [who, color] of [
    [page, 'pink #ff2f92'],
    [second, 'cyan #00e0c8'],
  ] as const) {
    await who.getByRole('button', { name: 'All', exact: true }).click();
    await who.getByRole('button', { name: `Colour ${color}`, exact: true }).click();
  }
  await saved(page);
  await second.context().setOffline(false);
  const dialog = second.getByRole('dialog', { name: /changed on another screen/ });
  await dialog.getByRole('button', { name: /Keep both/ }).click();
  await second.getByTestId('open-library').getByText('shared (copy)').waitFor();
  const color = async (name: string) => (await stored(page, name)).frames[0]?.pixels[0]?.color;
  expect(await color('shared')).toBe('#ff2f92');
  expect(await color('shared (copy)')).toBe('#00e0c8');
  await openShow(page, 'countdown');
});
