import { describe, expect, test } from 'vitest';
import { eventually } from './harness';
import { button, openShow, phaseIs, robotPlaces, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '12');

describe('the live view', () => {
  test('a show plays to its end, in two browsers alike', async () => {
    const page = await bed.open();
    const second = await bed.open('live', {
      viewport: { width: 1024, height: 768 },
    });
    await uploadText(page, 'two steps.json', smallShow(12, 4));
    // Both pages are watched at once: while one is awaited, the other may already have passed the state.
    const watched = [page, second].map(async (seer) => {
      await seer.getByText(/Playing frame 2 of 2/).waitFor();
      await phaseIs(seer, 'ready');
    });
    await button(page, 'Play').click();
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
  });

  test('pause holds, resume goes on, abort and Stop all end it', async () => {
    const page = await bed.open();
    await uploadText(page, 'long.json', smallShow(12, 60));
    await button(page, 'Play').click();
    await button(page, 'Pause').click();
    await phaseIs(page, 'paused');
    await button(page, 'Resume').click();
    await phaseIs(page, 'playing');
    await page.getByRole('button', { name: /^Abort/ }).click();
    await phaseIs(page, 'ready');
    await page.keyboard.press('Space');
    await phaseIs(page, 'playing');
    await page.getByRole('button', { name: 'Stop all' }).click();
    await phaseIs(page, 'ready');
  });

  test('too few robots: a message and a way to go on', async () => {
    const page = await bed.open();
    await uploadText(page, 'crowd.json', smallShow(14));
    await button(page, 'Play').click();
    const dialog = page.getByRole('dialog', { name: 'Before you start' });
    await dialog.waitFor();
    await dialog.getByRole('button').last().click();
    await phaseIs(page, 'playing');
    await page.keyboard.press('Escape');
    await phaseIs(page, 'ready');
  });

  test('a broken file is refused in words, and nothing else breaks', async () => {
    const page = await bed.open();
    await openShow(page, 'hello');
    await uploadText(page, 'broken.json', '{"lightbots": 1, "frames": [', false);
    await page
      .getByRole('alert')
      .getByText(/Can't import broken\.json/)
      .waitFor();
    await page.getByTestId('open-library').getByText('hello').waitFor();
  });

  test('it comes back by itself when the server does', async () => {
    const page = await bed.open();
    await bed.server.kill();
    await page.getByText('Server offline').waitFor();
    await bed.server.restart();
    await page.getByText('Connected', { exact: true }).waitFor();
    await page.getByText('12 robots', { exact: true }).waitFor();
  });
});
