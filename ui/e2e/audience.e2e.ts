import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { findings } from './axe';
import { eventually, openPage, startServer } from './harness';
import { button, phaseIs, pixelsAre, smallShow, uploadText } from './journeys';
import { openAs, startSignInServer } from './signedIn';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '12');
const SHOTS = process.env.SHOTS;

const view = (page: Page) => page.locator('[data-viewpoint]');

/** Loads the audience view in this page and waits for its canvas. */
async function watch(page: Page) {
  await page.goto(`${new URL(page.url()).origin}/#/audience`);
  await view(page).locator('canvas').waitFor();
}

/** Bright pixels of the canvas: their number, mean place, pixels of the canvas, and mean colour, 0 to 255. */
const lightOf = (page: Page) =>
  view(page)
    .locator('canvas')
    .evaluate(async (element) => {
      const seen = element as HTMLCanvasElement;
      const copy = new OffscreenCanvas(seen.width, seen.height);
      const context = copy.getContext('2d');
      if (!context) throw new Error('There is no second canvas.');
      context.drawImage(seen, 0, 0);
      const { data, width } = context.getImageData(0, 0, seen.width, seen.height);
      const sum = { lit: 0, x: 0, y: 0, red: 0, green: 0, blue: 0 };
      for (let at = 0; at < data.length; at += 4) {
        const [r, g, b] = [data[at] ?? 0, data[at + 1] ?? 0, data[at + 2] ?? 0];
        if (Math.max(r, g, b) < 90) continue;
        sum.lit++;
        sum.x += (at / 4) % width;
        sum.y += Math.floor(at / 4 / width);
        sum.red += r;
        sum.green += g;
        sum.blue += b;
      }
      const count = Math.max(1, sum.lit);
      const mean = Object.entries(sum).map(([name, all]) => [name, all / count]);
      return { ...(Object.fromEntries(mean) as typeof sum), lit: sum.lit };
    });

const shoot = async (page: Page, name: string) => {
  if (!SHOTS) return;
  const size = page.viewportSize();
  await page.screenshot({ path: `${SHOTS}/audience-${name}-${size?.width}.png` });
};

test('an audience sees the lights move in their colours, and nothing else', async () => {
  const desk = await bed.open();
  const hall = await bed.open();
  await watch(hall);
  expect(await hall.getByRole('button').count()).toBe(0);
  expect(await hall.getByRole('banner').count()).toBe(0);
  await uploadText(desk, 'moves.json', smallShow(12, 3));
  await button(desk, 'Play').click();
  await desk.getByText(/Playing frame 1 of 2/).waitFor();
  const first = await eventually(
    () => lightOf(hall),
    ({ lit, red, blue }) => lit > 100 && red > blue + 60,
    'the lights are orange',
  );
  expect(first.red).toBeGreaterThan(first.green);
  await shoot(hall, 'first');
  // The second picture is 0.2 m nearer to the front edge, which is below.
  await desk.getByText(/Playing frame 2 of 2/).waitFor();
  const moved = await eventually(
    () => lightOf(hall),
    ({ y, lit }) => lit > 100 && y > first.y + 20,
    'the lights move down',
  );
  expect(Math.abs(moved.x - first.x)).toBeLessThan(30);
  expect(await findings(hall)).toEqual([]);
  await phaseIs(desk, 'ready');
});

test('P turns to the perspective, which the screen remembers; F fills the screen; Esc leads back', async () => {
  const page = await bed.open();
  await watch(page);
  const above = await eventually(
    () => lightOf(page),
    ({ lit }) => lit > 50,
    'robots are seen before a run',
  );
  await page.keyboard.press('p');
  expect(await view(page).getAttribute('data-viewpoint')).toBe('front');
  await eventually(
    () => lightOf(page),
    ({ y, lit }) => lit > 50 && Math.abs(y - above.y) > 5,
    'the lights are elsewhere',
  );
  await page.reload();
  await view(page).locator('canvas').waitFor();
  expect(await view(page).getAttribute('data-viewpoint')).toBe('front');
  await view(page).dblclick();
  expect(await view(page).getAttribute('data-viewpoint')).toBe('above');
  const isFull = () => page.evaluate(() => document.fullscreenElement !== null);
  await page.keyboard.press('f');
  await eventually(isFull, (full) => full, 'the whole screen is filled');
  await page.keyboard.press('f');
  await eventually(isFull, (full) => !full, 'the screen is free again');
  await page.keyboard.press('Escape');
  await page.getByTestId('phase').waitFor();
  expect(page.url()).toMatch(/#\/live$/);
});

test('the pointer and the line about keys are shown after a move only', async () => {
  const page = await bed.open();
  await watch(page);
  const keys = page.getByText('full screen');
  const cursor = () => view(page).evaluate((element) => getComputedStyle(element).cursor);
  expect(await keys.count()).toBe(0);
  expect(await cursor()).toBe('none');
  await page.mouse.move(300, 300);
  await page.mouse.move(320, 310);
  await keys.waitFor();
  expect(await cursor()).toBe('default');
  expect(await findings(page)).toEqual([]);
  await shoot(page, 'keys');
  await eventually(cursor, (now) => now === 'none', 'the pointer is hidden');
  await keys.waitFor({ state: 'detached' });
});

test('the live page opens it in a window of its own', async () => {
  const page = await bed.open();
  const [popup] = await Promise.all([
    page.waitForEvent('popup'),
    button(page, 'Audience view (A)').click(),
  ]);
  expect(popup.url()).toMatch(/#\/audience$/);
  await view(popup).locator('canvas').waitFor();
  await popup.keyboard.press('Escape').catch(() => undefined);
  await eventually(
    async () => popup.isClosed(),
    (closed) => closed,
    'Esc closes the window',
  );
});

test('without a connection the last picture stays, with a dot in the corner, and goes on afterwards', async () => {
  const server = await startServer('--robots', '12');
  try {
    const desk = await openPage(bed.browser, server);
    const page = await openPage(bed.browser, server);
    await watch(page);
    await uploadText(desk, 'lost.json', smallShow(12));
    await button(desk, 'Play').click();
    await phaseIs(desk, 'playing');
    await phaseIs(desk, 'ready');
    const before = await eventually(
      () => lightOf(page),
      ({ lit }) => lit > 100,
      'robots are seen',
    );
    expect(await page.getByTestId('lost').count()).toBe(0);
    await server.kill();
    await page.getByTestId('lost').waitFor();
    expect((await lightOf(page)).lit).toBeGreaterThan(0.8 * before.lit);
    expect(await findings(page)).toEqual([]);
    await shoot(page, 'lost');
    await server.restart();
    await page.getByTestId('lost').waitFor({ state: 'detached' });
    // Robots of a new simulation have no light yet.
    await eventually(
      () => lightOf(page),
      ({ lit }) => lit === 0,
      'the new robots are seen',
    );
    await phaseIs(desk, 'ready');
    await button(desk, 'Play').click();
    await eventually(
      () => lightOf(page),
      ({ lit }) => lit > 100,
      'the next run is seen',
    );
    await Promise.all([desk.close(), page.close()]);
  } finally {
    await server.remove();
  }
});

test('a viewer may watch', async () => {
  const server = await startSignInServer('--robots', '6');
  try {
    const page = await openAs(bed.browser, server, 'viewer');
    await watch(page);
    const desk = await openAs(bed.browser, server, 'operator');
    await uploadText(desk, 'seen.json', smallShow(6));
    await button(desk, 'Play').click();
    await eventually(
      () => lightOf(page),
      ({ lit }) => lit > 50,
      'a viewer sees the lights',
    );
    await Promise.all([desk.close(), page.close()]);
  } finally {
    await server.remove();
  }
});

test('the preview is seen in the audience view, over the editor', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'preview.json', smallShow(12, 3));
  await pixelsAre(page, 12);
  await button(page, 'Audience view of the preview (A)').click();
  const dialog = page.getByRole('dialog', { name: 'Audience view' });
  await dialog.waitFor();
  const first = await eventually(
    () => lightOf(page),
    ({ lit, red, blue }) => lit > 100 && red > blue + 60,
    'the lights of the preview',
  );
  await eventually(
    () => lightOf(page),
    ({ y, lit }) => lit > 100 && y > first.y + 20,
    'the preview goes on',
  );
  expect(await findings(page)).toEqual([]);
  await shoot(page, 'preview');
  await page.keyboard.press('p');
  await eventually(
    () => dialog.getAttribute('data-viewpoint'),
    (viewpoint) => viewpoint === 'front',
    'the perspective',
  );
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'detached' });
  await pixelsAre(page, 12);
  await page.keyboard.press('a');
  await dialog.waitFor();
});
