import { mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, test } from 'vitest';
import { launchBrowser, openPage, startServer, type Server } from './harness';
import { FIRST_VIEWS, VIEWS, type View } from './views';

const docs = fileURLToPath(new URL('../../docs/', import.meta.url));
/** Folder for pictures of every view, for a review of the whole screen; undefined: none are taken. */
const everything = process.env.LIGHTBOTS_PICTURES;
/** Names of the README's pictures, without `.png`, by name of their view. */
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

/** Switches animations off, so that nothing fades in or out while a picture is taken. */
const still = { reducedMotion: 'reduce' } as const;

let browser: Browser;
let server: Server;
let empty: Server;
beforeAll(async () => {
  [server, empty, browser] = await Promise.all([
    startServer('--robots', '30'),
    startServer('--robots', '0'),
    launchBrowser(),
  ]);
});
afterAll(async () => {
  await browser?.close();
  await Promise.all([server?.remove(), empty?.remove()]);
});

async function walk(
  page: Page,
  on: Server,
  views: readonly View[],
  fileOf: (view: string) => string | undefined,
) {
  for (const view of views) {
    await view.show(page, on);
    const path = fileOf(view.name);
    if (path) await page.screenshot({ path });
    await view.leave?.(page);
  }
  await page.close();
}

test('the pictures of the README', async () => {
  const page = await openPage(browser, server, 'live', { ...still, scheme: 'dark' });
  await walk(page, server, VIEWS, (view) =>
    README[view] ? `${docs}${README[view]}.png` : undefined,
  );
});

for (const { name, ...options } of everything ? SIZES : [])
  for (const scheme of ['dark', 'light'])
    test(`every view, ${name}, ${scheme}`, async () => {
      const folder = `${everything}/${name}-${scheme}`;
      mkdirSync(folder, { recursive: true });
      const fileOf = (view: string) => `${folder}/${view}.png`;
      const fresh = await openPage(browser, empty, 'live', {
        ...options,
        ...still,
        scheme,
        tour: true,
      });
      await walk(fresh, empty, FIRST_VIEWS, fileOf);
      const page = await openPage(browser, server, 'live', { ...options, ...still, scheme });
      await walk(page, server, VIEWS, fileOf);
    });
