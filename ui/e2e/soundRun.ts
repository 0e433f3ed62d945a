import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { clicks, EVERY_S, FIRST_S } from './clicks';
import { eventually, launchBrowser, openPage, startRobots, startServer } from './harness';
import { button, phaseIs, uploadText } from './journeys';
import { startRecorder } from './recorder';
import { noteSound, type SoundNotes } from './soundNotes';
import { createBrowserBed } from './testBed';

/** Duration of the test, minutes. */
const MINUTES = Number(process.env.MINUTES ?? 5);
/** Number of robots of the show. */
const ROBOTS = 30;
/** Time for which one robot is stopped in every `EVERY_MS`, milliseconds; in a drive, all other robots hold then. */
const LATE_MS = 1500;
/** Time from one stop of the robot to its next, milliseconds. */
const EVERY_MS = 17_000;
const bed = createBrowserBed('sound');

/** A show of two rows of robots that go 0.3 m along y and back, until the end of the music. */
function show(): string {
  const frames = Array.from({ length: MINUTES * 5 }, (_, frame) => ({
    name: `Row ${frame + 1}`,
    air_time_s: 9,
    pixels: Array.from({ length: ROBOTS }, (_, id) => ({
      id,
      place: [-1.05 + (id % 15) * 0.15, (frame % 2) * 0.3 + Math.floor(id / 15) * 0.2],
      color: frame % 2 === 0 ? '#ff8800' : '#0088ff',
    })),
  }));
  const stage = { width_m: 3, depth_m: 3 };
  return JSON.stringify({ lightbots: 1, name: 'Clicks', stage, frames });
}

const notes = (page: Page) =>
  page.evaluate(() => (globalThis as unknown as { sound: SoundNotes }).sound);

const print = (clock: string, ahead_ms: readonly number[]) => {
  const signed = [...ahead_ms].sort((a, b) => a - b);
  const median_ms = signed[signed.length >> 1] ?? 0;
  const within = (from_ms: number) => {
    const sorted = ahead_ms.map((ms) => Math.abs(ms - from_ms)).sort((a, b) => a - b);
    return (of: number) => sorted[Math.min(sorted.length - 1, Math.floor(of * sorted.length))];
  };
  const share = within(0);
  const row = {
    clock,
    minutes: MINUTES,
    moments: ahead_ms.length,
    median_ahead_ms: median_ms,
    '95_%_within_of_the_median_ms': within(median_ms)(0.95),
    '95_%_within_ms': share(0.95),
    '99_%_within_ms': share(0.99),
    largest_ms: share(1),
  };
  process.stdout.write(`\n${JSON.stringify(row)}\n`);
};

/** Time by which recorded clicks are ahead of the show, milliseconds; without clicks while the show did not run. */
function aheadOf(recorded_ms: readonly number[], shows: SoundNotes['shows']): number[] {
  return recorded_ms.flatMap((heard_ms) => {
    const last = shows.findLast((one) => one.wall_ms <= heard_ms);
    if (!last?.runs || heard_ms - last.wall_ms > 500) return [];
    const show_s = last.show_s + (heard_ms - last.wall_ms) / 1000;
    const beat = Math.round((show_s - FIRST_S) / EVERY_S);
    return [1000 * (FIRST_S + beat * EVERY_S - show_s)];
  });
}

test(`${MINUTES} minutes with a pause, a hold and a late robot`, async () => {
  const recorder = await startRecorder(bed.folder);
  const browser = await launchBrowser(recorder.env);
  const file = join(bed.folder, 'empty.lightbots.json');
  writeFileSync(file, show());
  const server = await startServer(file, '--robots', String(ROBOTS - 1));
  try {
    const late = await startRobots(server, 1);
    const edit = await openPage(browser, server, 'edit');
    await uploadText(edit, 'clicks.json', show());
    await edit.getByRole('tab', { name: 'Show' }).click();
    const music = edit.getByRole('region', { name: 'Music' });
    const buffer = clicks(MINUTES * 60 + 20);
    await music
      .locator('input[type=file]')
      .setInputFiles({ name: 'c.wav', mimeType: 'audio/wav', buffer });
    await music.getByText(/c\.wav · /).waitFor();
    await edit.getByText('Saved', { exact: true }).first().waitFor();
    const page = await openPage(browser, server, 'live', {}, noteSound);
    await edit.close();
    await page.getByRole('button', { name: 'Music on this screen' }).click();
    await phaseIs(page, 'ready');
    await button(page, 'Play').click();
    await page.waitForTimeout(60_000);
    await button(page, 'Pause').click();
    await page.waitForTimeout(5_000);
    await page.getByRole('button', { name: /^(Go on|Resume)/ }).click();
    const ends_ms = Date.now() + MINUTES * 60_000 - 70_000;
    while (Date.now() < ends_ms) {
      await page.waitForTimeout(EVERY_MS - LATE_MS);
      process.kill(late.pid, 'SIGSTOP');
      await page.waitForTimeout(LATE_MS);
      process.kill(late.pid, 'SIGCONT');
    }
    const { ahead_ms, at_s, shows } = await notes(page);
    const far = ahead_ms.flatMap((ms, i) =>
      Math.abs(ms) > 100 ? [[at_s[i]?.toFixed(2), ms.toFixed(0)]] : [],
    );
    process.stdout.write(`\nfar off at, s and ms: ${far.join(' ')}\n`);
    const recorded = aheadOf(recorder.clicks_ms(), shows);
    print('audio clock of the browser', ahead_ms);
    print('recorded', recorded);
    await eventually(
      () => notes(page),
      (now) => now.starts > 1,
      'music went on after the pause',
    );
    expect(recorded.length).toBeGreaterThan(60 * MINUTES);
    await page.close();
  } finally {
    await browser.close();
    await server.remove();
    recorder.end();
  }
});
