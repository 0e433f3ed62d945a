import type { CDPSession, Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  chosenAre,
  onScreen,
  pixels,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

type At = { x: number; y: number };

const bed = createTestBed('--robots', '12');

const TABLET = { viewport: { width: 1024, height: 768 }, hasTouch: true };

/** Touches the page with several fingers at once. */
function fingers(client: CDPSession) {
  const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', places: At[]) =>
    client.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: places.map((at, id) => ({ ...at, id })),
    });
  return {
    down: (...places: At[]) => send('touchStart', places),
    up: () => send('touchEnd', []),
    /** Moves each finger straight from one place to another, in five steps. */
    async move(from: At[], to: At[]) {
      for (let k = 1; k <= 5; k++)
        await send(
          'touchMove',
          from.map((a, i) => ({
            x: a.x + (((to[i] ?? a).x - a.x) * k) / 5,
            y: a.y + (((to[i] ?? a).y - a.y) * k) / 5,
          })),
        );
    },
  };
}

const chosen = async (page: Page) =>
  (await pixels(page)).flatMap((p, id) => (p.chosen ? [id] : []));

test('a finger chooses and drags, held still it adds, two zoom and pan', async () => {
  const page = await bed.open('edit', TABLET);
  await uploadText(page, 'tablet.json', smallShow(12));
  await pixelsAre(page, 12);
  const hand = fingers(await page.context().newCDPSession(page));
  const places = await pixels(page);
  const at = async (id: number) => onScreen(page, places[id]?.x ?? 0, places[id]?.y ?? 0);
  const [first, sixth] = [await at(0), await at(6)];
  await page.keyboard.press('m');

  await page.touchscreen.tap(first.x, first.y);
  await chosenAre(page, [0]);
  await hand.down(sixth);
  await chosenAre(page, [0, 6]);
  await hand.up();
  // Lifting the finger where it rested opens the menu of the chosen pixels.
  await page.getByRole('menuitem', { name: 'Group' }).first().waitFor();
  await page.touchscreen.tap(sixth.x, sixth.y);
  await chosenAre(page, [6]);

  const step = { x: sixth.x, y: sixth.y + 60 };
  await hand.down(sixth);
  await hand.move([sixth], [step]);
  await hand.up();
  const once = await eventually(
    async () => (places[6]?.y ?? 0) - ((await pixels(page))[6]?.y ?? 0),
    (moved) => moved > 0.1,
    'it was dragged',
  );

  const pair = (away: number, dx = 0) => [
    { x: step.x - away + dx, y: step.y },
    { x: step.x + away + dx, y: step.y },
  ];
  await hand.down(...pair(50));
  await hand.move(pair(50), pair(100));
  await hand.move(pair(100), pair(100, 70));
  await hand.up();
  expect(await chosen(page)).toEqual([6]);
  const before = (await pixels(page))[6]?.y ?? 0;
  const from = { x: step.x + 70, y: step.y };
  await hand.down(from);
  await hand.move([from], [{ x: from.x, y: from.y + 60 }]);
  await hand.up();
  const twice = await eventually(
    async () => before - ((await pixels(page))[6]?.y ?? 0),
    (moved) => moved > 0.01,
    'it was dragged on the larger floor',
  );
  expect(once / twice).toBeGreaterThan(1.7);
  expect(once / twice).toBeLessThan(2.3);
});

test('whatever is pressed on a tablet is large enough for a finger', async () => {
  const page = await bed.open('live', TABLET);
  await uploadText(page, 'fingers.json', smallShow(12));
  const small = () =>
    page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('button, [role=tab], input')].flatMap((e) => {
        const { width, height } = e.getBoundingClientRect();
        const counts = e.checkVisibility() && !/radio|checkbox/.test(e.getAttribute('type') ?? '');
        const label = e.getAttribute('aria-label') ?? e.textContent ?? e.outerHTML;
        return counts && height > 1 && (width < 39.5 || height < 39.5)
          ? [`${label}: ${Math.round(width)} × ${Math.round(height)}`]
          : [];
      }),
    );
  await eventually(small, (list) => list.length === 0, 'the live view has room for fingers');
  await page.goto(`${bed.server.url}/#/edit`);
  await pixelsAre(page, 12);
  for (const tab of ['Pixels', 'Frame', 'Show']) {
    await page.getByRole('tab', { name: tab }).click();
    expect(await small()).toEqual([]);
  }
});

/** A show of `frames` frames, each with its number as its name. */
function longShow(frames: number): string {
  const show = JSON.parse(smallShow(6)) as { frames: { name: string }[] };
  const [first] = show.frames;
  return JSON.stringify({
    ...show,
    frames: Array.from({ length: frames }, (_, i) => ({ ...first, name: `${i + 1}` })),
  });
}

test('a finger that rests on a frame drags it; one that moves at once scrolls the strip', async () => {
  const page = await bed.open('edit', TABLET);
  await uploadText(page, 'strip.json', longShow(12));
  await pixelsAre(page, 6);
  const cards = page.getByRole('list', { name: 'Frames' }).locator('li');
  const hand = fingers(await page.context().newCDPSession(page));
  const at = async (index: number) => {
    const box = await cards.nth(index).boundingBox();
    if (!box) throw new Error(`Frame ${index} is not there.`);
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  };
  const order = async () =>
    (await stored(page, 'strip')).frames.map((frame) => frame.name).join(' ');
  const scrolled = () => page.getByRole('list', { name: 'Frames' }).evaluate((e) => e.scrollLeft);

  const [second, fourth] = [await at(1), await at(3)];
  await hand.down(second);
  await cards.and(page.locator('[data-held]')).waitFor();
  await hand.move([second], [fourth]);
  await hand.up();
  await eventually(order, (now) => now === '1 3 4 2 5 6 7 8 9 10 11 12', 'it was dragged');
  expect(await scrolled()).toBe(0);

  await hand.down(fourth);
  await hand.move([fourth], [{ x: fourth.x - 250, y: fourth.y }]);
  await hand.up();
  await eventually(scrolled, (left) => left > 100, 'the strip was scrolled');
  await saved(page);
  expect(await order()).toBe('1 3 4 2 5 6 7 8 9 10 11 12');

  // A tap still chooses.
  await cards.nth(7).tap();
  await cards.nth(7).locator('[aria-current=true]').waitFor();
});
