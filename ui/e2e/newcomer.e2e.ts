import type { Locator, Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { button, drag, drop, phaseIs, pixelsAre, saved, stored, tabTo } from './journeys';
import { createTestBed } from './testBed';

/** Most clicks from opening the page until a heart and a word play. */
const CLICKS_MAX = 8;

const bed = createTestBed('--robots', '30');

test('a newcomer makes a heart and a word with thirty robots, and plays them', async () => {
  const page = await bed.open('live', { tour: true });
  let clicks = 0;
  const click = async (target: Locator) => {
    clicks++;
    await target.click();
  };
  await page.getByText('30 robots', { exact: true }).waitFor();
  await click(button(page, 'New'));
  await click(button(page, 'Empty show'));
  await pixelsAre(page, 30);
  await click(button(page, 'Make…'));
  await click(page.getByText('Shape', { exact: true }));
  await click(button(page, 'Use'));
  await click(button(page, /^Add a frame/));
  await click(button(page, 'Make…'));
  await page.keyboard.type('HI');
  await page.keyboard.press('Enter');
  await button(page, 'Change…').waitFor();
  await saved(page);
  await click(button(page, 'Run on robots'));
  await phaseIs(page, 'playing');
  expect(clicks).toBeLessThanOrEqual(CLICKS_MAX);
  // From the beginning, though the last frame was the one being drawn.
  await page.getByText('Playing frame 1 of 2').waitFor();
  await page.getByRole('button', { name: /^Abort/ }).click();
  await phaseIs(page, 'ready');
});

/** A PNG like a photograph: a bright disc before a dark background. */
async function photograph(page: Page): Promise<Uint8Array> {
  const bytes = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(320, 240);
    const context = canvas.getContext('2d');
    if (!context) return [];
    const sky = context.createLinearGradient(0, 0, 0, 240);
    sky.addColorStop(0, '#101820');
    sky.addColorStop(1, '#20180c');
    context.fillStyle = sky;
    context.fillRect(0, 0, 320, 240);
    const moon = context.createRadialGradient(150, 110, 10, 160, 120, 80);
    moon.addColorStop(0, '#fff8e0');
    moon.addColorStop(1, '#d8b060');
    context.fillStyle = moon;
    context.beginPath();
    context.arc(160, 120, 80, 0, 7);
    context.fill();
    const blob = await canvas.convertToBlob({ type: 'image/png' });
    return [...new Uint8Array(await blob.arrayBuffer())];
  });
  return new Uint8Array(bytes);
}

// docs/first-show.md tells the same story; its number of clicks is the one here.
test('a show of five frames: a word, a shape, a drawing by hand, an SVG and a photograph', async () => {
  const page = await bed.open('live');
  const image = await photograph(page);
  let clicks = 0;
  const click = async (target: Locator) => {
    clicks++;
    await target.click();
  };
  const frames = page.getByRole('list', { name: 'Frames' }).getByRole('listitem');
  const use = async () => {
    await click(button(page, 'Use'));
    await button(page, 'Change…').waitFor();
  };
  await click(button(page, 'New'));
  await page.getByTestId('word-verdict').getByText('Readable').waitFor();
  await click(button(page, 'Make this show'));
  await pixelsAre(page, 30);
  await click(frames.last());
  await click(button(page, /^Add a frame/));
  await click(button(page, 'Draw a line (B)'));
  await drag(page, [-1, -0.5], [1, 0.5]);
  clicks++;
  await use();
  await click(button(page, /^Add a frame/));
  await drop(page, {
    files: {
      'bolt.svg':
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 12"><path d="M5 0L0 7h3l-1 5 6-8H5z" fill="gold"/></svg>',
    },
  });
  await use();
  await click(button(page, /^Add a frame/));
  await drop(page, { files: { 'moon.png': image } });
  await click(page.getByText('Outline', { exact: true }));
  await page.getByTestId('verdict').getByText('Readable').waitFor();
  await use();
  await saved(page);
  expect(await frames.allTextContents()).toEqual(
    ['HI', 'Ring', 'Freehand', 'Bolt', 'Moon'].map((name) => expect.stringContaining(name)),
  );
  await click(button(page, 'Run on robots'));
  await phaseIs(page, 'playing');
  await page.getByText('Playing frame 1 of 5').waitFor();
  await page.getByRole('button', { name: /^Abort/ }).click();
  await phaseIs(page, 'ready');
  expect(clicks).toBe(13);
});

test('by keyboard only: a new show, its pixels and colours, a second frame, and play', async () => {
  const page = await bed.open('live');
  const press = (key: string) => page.keyboard.press(key);
  await press('Control+o');
  await page.getByRole('dialog').waitFor();
  await tabTo(page, 'button', 'New show');
  await press('Enter');
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  await tabTo(page, 'button', 'Empty show');
  await press('Enter');
  await pixelsAre(page);
  const name = (await page.getByTestId('show-name').textContent()) ?? '';
  await tabTo(page, 'tab', 'Pixels');
  await press('ArrowRight');
  await press('ArrowRight');
  await press('ArrowRight');
  await tabTo(page, 'textbox', 'Number of robots');
  await press('Control+a');
  await page.keyboard.type('9');
  await press('Enter');
  await pixelsAre(page, 9);
  await tabTo(page, 'tab', 'Show');
  await press('ArrowLeft');
  await press('ArrowLeft');
  await press('ArrowLeft');
  await press('s');
  await tabTo(page, 'button', 'Use');
  await press('Enter');
  await button(page, 'Change…').waitFor();
  await tabTo(page, 'button', 'All');
  await press('Enter');
  await tabTo(page, 'button', 'Colour pink #ff2f92');
  await press('Enter');
  await press('Control+Enter');
  await press('Shift+ArrowUp');
  await saved(page);
  const { frames } = await stored(page, name);
  expect(frames.map((f) => f.pixels.length)).toEqual([9, 9]);
  expect(frames.every((f) => f.pixels.every((p) => p.color === '#ff2f92'))).toBe(true);
  expect((frames[1]?.pixels[0]?.place[1] ?? 0) - (frames[0]?.pixels[0]?.place[1] ?? 0)).toBeCloseTo(
    0.1,
    3,
  );
  await press('g');
  await page.getByTestId('phase').waitFor();
  await phaseIs(page, 'ready');
  await press('Home');
  await press('Space');
  await phaseIs(page, 'playing');
  await press('Escape');
  await phaseIs(page, 'ready');
});
