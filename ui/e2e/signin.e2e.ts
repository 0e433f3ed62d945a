import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { findings } from './axe';
import { firstAddress, launchBrowser, startServer, type Server } from './harness';

let server: Server;
let browser: Browser;
const NAME = 'ann';
const PASSWORD = 'a long password';

beforeAll(async () => {
  const network = ['--listen', '0.0.0.0:0', '--robots', '0'];
  [server, browser] = await Promise.all([startServer(...network), launchBrowser()]);
});
afterAll(async () => {
  await browser.close();
  await server.remove();
});

async function submit(page: Page, password: string, button: string) {
  await page.getByLabel('Name').fill(NAME);
  await page.getByLabel('Password', { exact: true }).fill(password);
  await page.getByRole('button', { name: button }).click();
}

/** HTTP status of a request for the page's session: 200 while it is signed in. */
const session = (page: Page) => page.evaluate(async () => (await fetch('/api/session')).status);

test('the first operator comes by the one-time address, signs out, and signs in again', async () => {
  const token = await firstAddress(server);
  const page = await browser.newPage({ ignoreHTTPSErrors: true });
  await page.goto(`${server.url}/${token}`);
  await page.getByRole('heading', { name: 'Make the first operator' }).waitFor();
  expect(page.url()).not.toContain('first');
  expect(await findings(page)).toEqual([]);
  await submit(page, 'short', 'Make the first operator');
  await page.getByText('A password has at least 8 characters.').waitFor();
  await submit(page, PASSWORD, 'Make the first operator');
  await page.waitForEvent('load');
  expect(await session(page)).toBe(200);
  expect(await page.evaluate(() => isSecureContext)).toBe(true);
  await page.evaluate(() => fetch('/api/session', { method: 'DELETE' }));
  await page.goto(server.url);
  await submit(page, 'a guess', 'Sign in');
  await page.getByText('Name or password is wrong. Four more tries').waitFor();
  await submit(page, PASSWORD, 'Sign in');
  await page.waitForEvent('load');
  expect(await session(page)).toBe(200);
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByText('Signed in as ann (operator)').waitFor();
  await page.getByRole('button', { name: 'Sign out' }).click();
  await page.getByRole('heading', { name: 'Sign in' }).waitFor();
  await page.close();
});

for (const colorScheme of ['dark', 'light'] as const)
  for (const [width, height] of [
    [1440, 900],
    [390, 844],
  ] as const)
    test(`nothing serious on the sign-in page, ${colorScheme}, ${width} wide`, async () => {
      const page = await browser.newPage({
        ignoreHTTPSErrors: true,
        colorScheme,
        viewport: { width, height },
      });
      await page.goto(server.url);
      await page.getByRole('heading', { name: 'Sign in' }).waitFor();
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      expect(wide).toBeLessThanOrEqual(width);
      expect(await findings(page)).toEqual([]);
      if (process.env.SHOTS)
        await page.screenshot({ path: `${process.env.SHOTS}/signin-${colorScheme}-${width}.png` });
      await page.close();
    });
