import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { eventually, launchBrowser, mistakes, openPage, startServer, type Server } from './harness';
import { openShow, pixels, saved, smallShow, stored, uploadText } from './journeys';

let browser: Browser;
let server: Server;
beforeAll(async () => {
  [server, browser] = await Promise.all([startServer('--robots', '6'), launchBrowser()]);
});
afterAll(async () => {
  await browser?.close();
  await server?.remove();
  expect(mistakes).toEqual([]);
});

test('server and page both die in the middle of an edit, and nothing is lost', async () => {
  const page = await openPage(browser, server, 'edit');
  await uploadText(page, 'dying.json', smallShow(6));
  await server.kill();
  await page.getByRole('button', { name: 'All', exact: true }).click();
  await page.getByRole('button', { name: 'Colour violet #b14cff', exact: true }).click();
  await page.getByText('Not saved yet').waitFor();
  await page.goto('about:blank');
  await server.restart();
  await page.goto(`${server.url}/#/live`);
  await page.getByText(/Changes of dying.* never reached the server/).waitFor();
  await page.getByRole('button', { name: 'Put them back' }).click();
  await saved(page);
  const document = await stored(page, 'dying');
  expect(document.frames[0]?.pixels.every((p) => p.color === '#b14cff')).toBe(true);
  await page.close();
});

test('two browsers change one show at once: nobody overwrites the other silently', async () => {
  const page = await openPage(browser, server, 'edit');
  await uploadText(page, 'shared.json', smallShow(6));
  const second = await openPage(browser, server, 'edit');
  await eventually(
    () => pixels(second),
    (p) => p.length === 6,
    'the second browser has it',
  );
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
  const dialog = second.getByRole('dialog', { name: /Somebody else saved/ });
  await dialog.getByRole('button', { name: /Keep both/ }).click();
  await second.getByTestId('open-library').getByText('shared mine').waitFor();
  const color = async (name: string) => (await stored(page, name)).frames[0]?.pixels[0]?.color;
  expect(await color('shared')).toBe('#ff2f92');
  expect(await color('shared mine')).toBe('#00e0c8');
  await openShow(page, 'countdown');
  await page.close();
  await second.close();
});
