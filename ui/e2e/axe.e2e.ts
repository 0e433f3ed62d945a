import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { openPage, startServer, type Server } from './harness';
import { createTestBed } from './testBed';
import { FIRST_VIEWS, VIEWS, type View } from './views';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const bed = createTestBed('--robots', '30');

/** What axe finds that is serious, one line each. */
async function findings(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const run = (globalThis as unknown as { axe: { run(): Promise<AxeResult> } }).axe.run;
    const { violations } = await run();
    return violations
      .filter((v) => v.impact === 'serious' || v.impact === 'critical')
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 160)).join(' | ')}`);
  });
}

interface AxeResult {
  violations: { id: string; impact: string; nodes: { html: string }[] }[];
}

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
