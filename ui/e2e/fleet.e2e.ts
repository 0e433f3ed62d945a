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
  await page.getByLabel('Robot that always shows it').first().click();
  await page.getByRole('option', { name: 'Any robot' }).click();
  await saved(page);
  expect((await robots()).flat().every((robot) => robot === null)).toBe(true);
  await page.close();
});

test('the checklist says what is missing, Stop all is above it, and one can go on without', async () => {
  const page = await openPage(browser, server);
  await uploadText(page, 'eight.json', smallShow(8));
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  const dialog = page.getByRole('dialog', { name: 'Not quite ready' });
  await dialog.getByText(/6 of 8 ready; 2 never seen/).waitFor();
  expect(await dialog.locator('[data-verdict=good]').count()).toBeGreaterThanOrEqual(3);
  await page.locator('.stop-all').click();
  await dialog.getByRole('button', { name: 'Play with 6 robots' }).click();
  await page.getByText(/Playing frame 2 of 2/).waitFor();
  await page.keyboard.press('Escape');
  await eventually(
    () => phase(page),
    (p) => p === 'ready',
    'ready',
  );
  await page.close();
});

test('the library: pictures, save as, rename, download, delete and undo', async () => {
  const page = await openPage(browser, server, 'edit');
  await uploadText(page, 'kept.json', smallShow(6));
  const menu = async (name: string, item: string) => {
    await page.getByRole('button', { name: `What to do with ${name}`, exact: true }).click();
    await page.getByRole('menuitem', { name: item, exact: true }).click();
  };
  const names = () =>
    page.evaluate(async () =>
      ((await (await fetch('/api/shows')).json()) as { name: string }[]).map((e) => e.name),
    );
  await page.getByTestId('open-library').click();
  await page.locator('.entry-picture canvas').first().waitFor();
  await menu('kept', 'Save as…');
  await page.getByRole('dialog').last().getByLabel('Name', { exact: true }).fill('second');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByTestId('open-library').getByText('second').waitFor();
  await page.getByTestId('open-library').click();
  await menu('second', 'Rename…');
  await page.getByRole('dialog').last().getByLabel('Name', { exact: true }).fill('third');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByTestId('open-library').getByText('third').waitFor();
  const file = page.waitForEvent('download');
  await menu('third', 'Download');
  expect((await file).suggestedFilename()).toBe('third.lightbots.json');
  await menu('kept', 'Delete');
  await eventually(names, (all) => !all.includes('kept') && all.includes('third'), 'deleted');
  await page.getByRole('button', { name: 'Undo', exact: true }).last().click();
  await eventually(names, (all) => all.includes('kept') && !all.includes('second'), 'back');
  await page.close();
});
