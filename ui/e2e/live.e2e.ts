import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { eventually, launchBrowser, mistakes, openPage, startServer, type Server } from './harness';
import { openShow, phase, robotPlaces, smallShow, uploadText } from './journeys';

let browser: Browser;
let server: Server;
beforeAll(async () => {
  [server, browser] = await Promise.all([startServer('--robots', '12'), launchBrowser()]);
});
afterAll(async () => {
  await browser?.close();
  await server?.remove();
  expect(mistakes).toEqual([]);
});

describe('the live view', () => {
  test('a show plays to its end, in two browsers alike', async () => {
    const page = await openPage(browser, server);
    const second = await openPage(browser, server, 'live', {
      viewport: { width: 1024, height: 768 },
    });
    await uploadText(page, 'two steps.json', smallShow(12, 4));
    // Both are watched at once: what one sees late the other may not see any more.
    const watched = [page, second].map(async (seer) => {
      await seer.getByText(/Playing frame 2 of 2/).waitFor();
      await eventually(
        () => phase(seer),
        (p) => p === 'ready',
        'the end',
      );
    });
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await Promise.all(watched);
    const places = await eventually(
      () => robotPlaces(page),
      (all) => all.length === 12,
      'all robots are listed',
    );
    for (const [x, y] of places) {
      const wanted = Array.from({ length: 12 }, (_, i) => [-0.55 + i * 0.1, 0.9] as const);
      const off = Math.min(...wanted.map(([wx, wy]) => Math.hypot(wx - x, wy - y)));
      expect(off).toBeLessThan(0.05);
    }
    await page.close();
    await second.close();
  });

  test('pause holds, resume goes on, abort and Stop all end it', async () => {
    const page = await openPage(browser, server);
    await uploadText(page, 'long.json', smallShow(12, 60));
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await page.getByRole('button', { name: 'Pause', exact: true }).click();
    await eventually(
      () => phase(page),
      (p) => p === 'paused',
      'paused',
    );
    await page.getByRole('button', { name: 'Resume', exact: true }).click();
    await eventually(
      () => phase(page),
      (p) => p === 'playing',
      'playing again',
    );
    await page.getByRole('button', { name: /^Abort/ }).click();
    await eventually(
      () => phase(page),
      (p) => p === 'ready',
      'ready after abort',
    );
    await page.keyboard.press('Space');
    await eventually(
      () => phase(page),
      (p) => p === 'playing',
      'playing by key',
    );
    await page.getByRole('button', { name: 'Stop all' }).click();
    await eventually(
      () => phase(page),
      (p) => p === 'ready',
      'ready after Stop all',
    );
    await page.close();
  });

  test('too few robots: a message and a way to go on', async () => {
    const page = await openPage(browser, server);
    await uploadText(page, 'crowd.json', smallShow(14));
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    const dialog = page.getByRole('dialog', { name: 'Not quite ready' });
    await dialog.waitFor();
    await dialog.getByRole('button').last().click();
    await eventually(
      () => phase(page),
      (p) => p === 'playing',
      'playing without them',
    );
    await page.keyboard.press('Escape');
    await eventually(
      () => phase(page),
      (p) => p === 'ready',
      'ready after abort',
    );
    await page.close();
  });

  test('a broken file is refused in words, and nothing else breaks', async () => {
    const page = await openPage(browser, server);
    await openShow(page, 'hello');
    await uploadText(page, 'broken.json', '{"lightbots": 1, "frames": [', false);
    await page
      .getByRole('alert')
      .getByText(/broken\.json was not taken/)
      .waitFor();
    await page.getByTestId('open-library').getByText('hello').waitFor();
    await page.close();
  });

  test('it comes back by itself when the server does', async () => {
    const page = await openPage(browser, server);
    await server.kill();
    await page.getByText('Server away').waitFor();
    await server.restart();
    await page.getByText('Connected', { exact: true }).waitFor();
    await page.getByText('12 robots', { exact: true }).waitFor();
    await page.close();
  });
});
