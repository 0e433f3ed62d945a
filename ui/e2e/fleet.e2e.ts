import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { eventually, launchBrowser, mistakes, openPage, startServer, type Server } from './harness';
import { phase, pixels, saved, smallShow, stored, uploadText } from './journeys';

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

test('a robot is pinned to a pixel from both views, shows it, and is freed again', async () => {
  const page = await openPage(browser, server);
  await uploadText(page, 'pins.json', smallShow(6));
  const robots = async () =>
    (await stored(page, 'pins')).frames.map((f) => f.pixels.map((p) => p.robot ?? null));
  await page.getByText('6 robots', { exact: true }).waitFor();
  await page
    .getByRole('button', { name: /^More about robot/ })
    .last()
    .click();
  const dialog = page.getByRole('dialog', { name: /^Robot / });
  const name = await dialog.locator('dd').first().textContent();
  await dialog.getByLabel('Always shows').first().click();
  await page.getByRole('option', { name: 'Pixel 0' }).click();
  await eventually(robots, (all) => all.every((frame) => frame[0] === name), 'it is pinned');
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByText(/Playing frame 2 of 2/).waitFor();
  const line = page.getByRole('row').filter({ hasText: name?.slice(0, 8) ?? '' });
  expect(await line.getByRole('cell').first().textContent()).toBe('0');
  await eventually(
    () => phase(page),
    (p) => p === 'ready',
    'the end',
  );
  await page.getByRole('button', { name: 'All columns' }).click();
  await page.getByRole('columnheader', { name: 'Firmware' }).waitFor();
  await page.getByText('Edit', { exact: true }).click();
  await eventually(
    () => pixels(page),
    (all) => all.length === 6,
    'pixels',
  );
  await page.keyboard.press(']');
  expect((await pixels(page))[0]?.text).toContain('pinned');
  await page.getByRole('button', { name: 'Free the pixel' }).click();
  await saved(page);
  expect((await robots()).flat().every((robot) => robot === null)).toBe(true);
  await page.close();
});
