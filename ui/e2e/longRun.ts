import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import type { RunEntry } from '../src/api/types.gen';
import { crowdShow, LAYERS } from './crowds';
import { measure, noteDraws } from './drawnFrames';
import { eventually, openPage, startServer, type Server } from './harness';
import { openHiddenTabs } from './hiddenTabs';
import { createBrowserBed } from './testBed';

/** Number of simulated robots. */
const ROBOTS = Number(process.env.ROBOTS ?? 1000);
/** Duration of the test, minutes. */
const MINUTES = Number(process.env.MINUTES ?? 30);
/** Minutes between two rows. */
const EVERY = 5;

const bed = createBrowserBed('long');

/** Resident memory of a process, kB. */
const resident_kB = (pid: number) =>
  Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))?.[1] ?? 0);

/** Ids of the processes that a process started, such as the server's broker. */
const children = (pid: number) =>
  readFileSync(`/proc/${pid}/task/${pid}/children`, 'utf8').split(' ').filter(Boolean).map(Number);

/** Memory of a page's scripts after a garbage collection, bytes. */
async function heapOf(page: Page): Promise<number> {
  const client = await page.context().newCDPSession(page);
  await client.send('HeapProfiler.collectGarbage');
  const { usedSize } = await client.send('Runtime.getHeapUsage');
  await client.detach();
  return usedSize;
}

async function row(server: Server, front: Page, minute: number) {
  const { fps, late_ms } = await measure(front, 10_000);
  const heap_bytes = await heapOf(front);
  print({
    minute,
    robots: ROBOTS,
    frames_a_second: fps,
    '95_%_of_gaps_below_ms': late_ms,
    server_MB: resident_kB(server.pid()) / 1000,
    broker_MB: children(server.pid()).reduce((sum, pid) => sum + resident_kB(pid), 0) / 1000,
    page_MB: heap_bytes / 1e6,
    report_s: null,
  });
}

const expectHidden = (state: unknown) => expect(state).toBe('hidden');

const print = (value: object) => process.stdout.write(`\n${JSON.stringify(value)}\n`);

/** Waits until the newest run has ended, and answers it. */
const lastRun = (page: Page) =>
  eventually(
    () => page.evaluate(async () => ((await (await fetch('/api/runs')).json()) as RunEntry[])[0]),
    (run) => typeof run?.ended_ms === 'number',
    'the run is over',
  );

test(`${MINUTES} minutes of a show with ${ROBOTS} robots in three pages`, async () => {
  const file = join(bed.folder, 'long.lightbots.json');
  writeFileSync(file, crowdShow(ROBOTS, LAYERS));
  const server = await startServer(file, '--robots', String(ROBOTS));
  try {
    const behind = await openHiddenTabs(bed.browser, `${server.url}/#/live`, 2, 'Connected');
    const front = await openPage(bed.browser, server, 'live', {}, noteDraws);
    await front.bringToFront();
    await front.getByText(`${ROBOTS} robots`, { exact: true }).waitFor();
    await front.getByRole('button', { name: 'Loop (L)' }).click();
    await front.getByRole('button', { name: 'Play', exact: true }).click();
    await front.getByText(/Playing frame 2 of/).waitFor();
    const began = Date.now();
    for (let minute = 1; minute <= MINUTES; minute += minute === 1 ? EVERY - 1 : EVERY) {
      await front.waitForTimeout(Math.max(0, began + minute * 60_000 - Date.now()));
      await row(server, front, minute);
    }
    for (const tab of behind) await tab.ask('document.visibilityState').then(expectHidden);
    await front.keyboard.press('Escape');
    const run = await lastRun(front);
    const asked = Date.now();
    const report = await bed.browser.newPage();
    await report.goto(`${server.url}/api/runs/${run?.number}/report`, { timeout: 120_000 });
    await report.getByRole('heading').first().waitFor();
    print({ minute: MINUTES, robots: ROBOTS, report_s: (Date.now() - asked) / 1000 });
    await Promise.all([front, report].map((page) => page.close()));
  } finally {
    await server.remove();
  }
});
