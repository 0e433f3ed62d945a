import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { findings } from './axe';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');
const OUTCOME = 'All 2 frames shown, no robot lost.';

test('a run ends with its report: read in a tab, saved as a file, and in the list of past runs', async () => {
  const page = await bed.open('live', { acceptDownloads: true });
  await uploadText(page, 'told.json', smallShow(6));
  await page.getByText('6 robots', { exact: true }).waitFor();
  await button(page, 'Play').click();
  await phaseIs(page, 'playing');
  const note = page.getByTestId('run-note');
  expect(await note.count()).toBe(0);
  await note.getByText(OUTCOME).waitFor();
  expect(await findings(page)).toEqual([]);

  const [report] = await Promise.all([
    page.context().waitForEvent('page'),
    note.getByRole('link', { name: 'Read the report' }).click(),
  ]);
  await report.getByRole('heading', { name: OUTCOME }).waitFor();
  // The report's script runs, but its origin is opaque, so that it can read nothing of the server.
  const now = report.locator('#now');
  await report.getByLabel('Moment of the show').fill('1');
  expect(await now.textContent()).toBe('0:01.0');
  expect(await report.evaluate(() => self.origin)).toBe('null');
  expect(await findings(report)).toEqual([]);
  await report.close();

  const [download] = await Promise.all([
    page.waitForEvent('download'),
    note.getByRole('link', { name: 'Download' }).click(),
  ]);
  expect(download.suggestedFilename()).toBe('lightbots-run-1.html');
  expect(readFileSync(await download.path(), 'utf8')).toContain(OUTCOME);

  await button(page, 'Dismiss the report').click();
  await note.waitFor({ state: 'detached' });
  await page.reload();
  await phaseIs(page, 'ready');
  expect(await note.count()).toBe(0);
  await page.getByRole('tab', { name: 'Log' }).click();
  await button(page, 'Past runs').click();
  const list = page.getByRole('list', { name: 'Past runs' });
  await list.getByText(OUTCOME).waitFor();
  expect(await findings(page)).toEqual([]);
  await page.keyboard.press('Escape');
  await page.goto(`${bed.server.url}/#/new`);
  await button(page, 'Past runs and their reports').click();
  await list.getByRole('link', { name: /Read the report of run 1/ }).waitFor();
});
