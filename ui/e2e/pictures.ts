import { mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { test } from 'vitest';
import { eventually, launchBrowser, openPage, startServer } from './harness';
import { openShow, phase, pixels, saved } from './journeys';

const docs = fileURLToPath(new URL('../../docs/', import.meta.url));

test('the pictures of the README', async () => {
  mkdirSync(docs, { recursive: true });
  const [server, browser] = await Promise.all([startServer('--robots', '30'), launchBrowser()]);
  try {
    const page = await openPage(browser, server);
    await openShow(page, 'heart');
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await page.getByText(/Playing frame 3 of/).waitFor();
    await eventually(
      () => page.getByRole('progressbar').first().getAttribute('aria-valuenow'),
      (value) => Number(value) > 45,
      'the middle of a drive',
    );
    await page.screenshot({ path: `${docs}live.png` });
    await page.keyboard.press('Escape');
    await eventually(
      () => phase(page),
      (p) => p === 'ready',
      'ready',
    );
    await page.goto(`${server.url}/#/edit`);
    await eventually(
      () => pixels(page),
      (p) => p.length > 0,
      'pixels',
    );
    await page.getByRole('button', { name: /^2/ }).first().click();
    await page.getByRole('button', { name: 'All', exact: true }).click();
    await saved(page);
    await page.screenshot({ path: `${docs}editor.png` });
  } finally {
    await browser.close();
    await server.remove();
  }
});
