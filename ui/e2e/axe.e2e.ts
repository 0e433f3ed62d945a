import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { findings } from './axe';
import { openPage, startServer, type Server } from './harness';
import { createTestBed } from './testBed';
import { FIRST_VIEWS, VIEWS, type View } from './views';

const bed = createTestBed('--robots', '30');

async function look(page: Page, on: Server, views: readonly View[]) {
  const found: string[] = [];
  for (const view of views) {
    await view.show(page, on);
    found.push(...(await findings(page)).map((finding) => `${view.name}: ${finding}`));
    await view.leave?.(page);
  }
  await page.close();
  expect(found).toEqual([]);
}

for (const scheme of ['dark', 'light']) {
  const options = { reducedMotion: 'reduce', scheme } as const;
  test(`nothing serious on any view, ${scheme}`, async () => {
    await look(await bed.open('live', options), bed.server, VIEWS);
  });
  test(`nothing serious at the first sight, ${scheme}`, async () => {
    const empty = await startServer('--robots', '0');
    try {
      const page = await openPage(bed.browser, empty, 'live', { ...options, tour: true });
      await look(page, empty, FIRST_VIEWS);
    } finally {
      await empty.remove();
    }
  });
}
