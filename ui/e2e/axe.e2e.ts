import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { launchBrowser, mistakes, openPage, startServer, type Server } from './harness';
import { openShow } from './journeys';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

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

for (const scheme of ['dark', 'light'] as const) {
  test(`nothing serious on any view, ${scheme}`, async () => {
    const page = await openPage(browser, server, 'live', { reducedMotion: 'reduce' });
    await page.evaluate((s) => localStorage.setItem('mantine-color-scheme-value', s), scheme);
    await page.reload();
    await openShow(page, 'hello');
    await page.getByRole('list', { name: 'Frames' }).waitFor();
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    expect(await findings(page)).toEqual([]);
    for (const tab of ['Show', 'Log']) {
      await page.getByRole('tab', { name: tab }).click();
      expect(await findings(page)).toEqual([]);
    }
    await page.keyboard.press('c');
    await page.getByRole('list', { name: 'Checklist' }).waitFor();
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    await page.getByRole('tab', { name: 'Robots' }).click();
    await page
      .getByRole('button', { name: /^More about robot/ })
      .first()
      .click();
    await page.getByRole('dialog').waitFor();
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    await page.goto(`${server.url}/#/edit`);
    await page.getByTestId('pixels').waitFor({ state: 'attached' });
    for (const tab of ['Pixels', 'Frame', 'Show']) {
      await page.getByRole('tab', { name: tab }).click();
      expect(await findings(page)).toEqual([]);
    }
    for (const opener of ['Settings', 'Keyboard map']) {
      await page.getByRole('button', { name: opener }).click();
      await page.getByRole('dialog').waitFor();
      expect(await findings(page)).toEqual([]);
      await page.keyboard.press('Escape');
      await page.getByRole('dialog').waitFor({ state: 'hidden' });
    }
    await page.getByTestId('open-library').click();
    await page.getByRole('list', { name: 'Shows in the library' }).waitFor();
    expect(await findings(page)).toEqual([]);
    await page.close();
  });
}
