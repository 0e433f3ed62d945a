import { mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, test } from 'vitest';
import { launchBrowser, openPage, startServer, type Server } from './harness';
import { VIEWS } from './views';

const docs = fileURLToPath(new URL('../../docs/', import.meta.url));
/** Where pictures of every view go, for those who look over the whole screen; none are taken without it. */
const everything = process.env.LIGHTBOTS_PICTURES;
/** Views whose pictures are in the README, and what they are called there. */
const README: Record<string, string> = {
  'live-playing': 'live',
  'edit-chosen': 'editor',
  'edit-scrubbing': 'scrubbing',
};
const SIZES = [
  { name: '1440', viewport: { width: 1440, height: 900 } },
  { name: '1024', viewport: { width: 1024, height: 768 }, hasTouch: true },
  { name: '2560', viewport: { width: 2560, height: 1440 } },
];

let browser: Browser;
let server: Server;
beforeAll(async () => {
  [server, browser] = await Promise.all([startServer('--robots', '30'), launchBrowser()]);
});
afterAll(async () => {
  await browser?.close();
  await server?.remove();
});

async function walk(page: Page, fileOf: (view: string) => string | undefined) {
  for (const view of VIEWS) {
    await view.show(page, server);
    const path = fileOf(view.name);
    if (path) await page.screenshot({ path });
    await view.leave?.(page);
  }
  await page.close();
}

test('the pictures of the README', async () => {
  const page = await openPage(browser, server, 'live');
  await walk(page, (view) => (README[view] ? `${docs}${README[view]}.png` : undefined));
});

for (const { name, ...options } of everything ? SIZES : [])
  for (const scheme of ['dark', 'light'])
    test(`every view, ${name}, ${scheme}`, async () => {
      const folder = `${everything}/${name}-${scheme}`;
      mkdirSync(folder, { recursive: true });
      const page = await openPage(browser, server, 'live', { ...options, scheme });
      await walk(page, (view) => `${folder}/${view}.png`);
    });
