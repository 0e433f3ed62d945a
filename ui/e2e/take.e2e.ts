import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { gifOf } from '../src/make/gif.testing';
import { eventually } from './harness';
import {
  beginEmpty,
  button,
  drop,
  hold,
  paste,
  pixels,
  pixelsAre,
  saved,
  smallShow,
  tabTo,
  useMade,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '30');

const HEART =
  '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-6 -6 12 12"><path d="M0 3C-6 -3 -3 -6 0 -3C3 -6 6 -3 0 3"/></svg>';

const verdict = (page: Page) => page.getByTestId('verdict');
const words = (page: Page) => page.getByRole('textbox', { name: 'Words' });
const frames = (page: Page) => page.getByRole('list', { name: 'Frames' }).getByRole('listitem');

async function begin(): Promise<Page> {
  const page = await bed.open('live');
  await beginEmpty(page);
  await pixelsAre(page, 30);
  return page;
}

test('a drawing that is held over the page says what happens, and makes the frame when dropped', async () => {
  const page = await begin();
  await hold(page, { files: { 'heart.svg': HEART } });
  await page.getByText('Drop the picture to make the frame from it').waitFor();
  await drop(page, { files: { 'heart.svg': HEART } });
  await page.getByTestId('veil').waitFor({ state: 'detached' });
  await page.getByText('heart.svg', { exact: true }).waitFor();
  await useMade(page);
  await page.getByText('Made from the file heart.svg').waitFor();
});

test('a list and a show are dropped, and another show takes the place of this one', async () => {
  const page = await begin();
  const list = Array.from({ length: 30 }, (_, n) => `${n % 6},${Math.floor(n / 6)},red`).join('\n');
  await drop(page, { files: { 'list.csv': list } });
  await verdict(page).getByText('Room for all 30 robots').waitFor();
  await button(page, 'Cancel').click();
  // The file's name does not tell that it is a show, so that its content is examined.
  await drop(page, { files: { 'other.txt': smallShow(12) } });
  await page.getByText('Imported and opened "other.txt".').waitFor();
  await pixelsAre(page, 12);
});

test('what cannot be used says what it is, and what can', async () => {
  const page = await begin();
  await drop(page, { files: { 'paper.pdf': '%PDF-1.7' } });
  const told = page.getByRole('alert').getByText(/paper\.pdf/);
  expect(await told.textContent()).toMatch(/The file is a PDF.*You can use drawings \(SVG\)/);
  expect(await button(page, 'Use').count()).toBe(0);
});

test('pasted words, a drawing as text and a list are made; words go into their field as ever', async () => {
  const page = await begin();
  await paste(page, { text: 'HI' });
  await verdict(page).getByText('Readable').waitFor();
  expect(await words(page).inputValue()).toBe('HI');
  await button(page, 'Cancel').click();
  await paste(page, { text: HEART });
  await page.getByText('Pasted.svg').waitFor();
  await paste(page, { text: 'x,y\n0,0\n1,1' });
  await page.getByText('Pasted.csv').waitFor();
  await useMade(page);
  await page.keyboard.press('Control+z');
  await drop(page, { text: 'OH' });
  await verdict(page).getByText('Readable').waitFor();
  expect(await words(page).inputValue()).toBe('OH');
});

test('by keyboard: pixels are copied and pasted into another frame', async () => {
  const page = await begin();
  await page.keyboard.press(']');
  await page.keyboard.press('Shift+ArrowUp');
  const place = (await pixels(page))[0];
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+Enter');
  expect((await pixels(page))[0]?.y).not.toBe(place?.y);
  await page.keyboard.press('Control+v');
  await eventually(
    () => pixels(page),
    ([first]) => first?.y === place?.y,
    'the pixel has the copied place',
  );
});

test('an animation becomes several frames in one step, which one undo takes back', async () => {
  const page = await begin();
  await drop(page, { files: { 'walk.gif': gifOf([0, 10, 20, 30]) } });
  const use = page.getByRole('button', { name: /^Use \d frames$/ });
  await use.waitFor();
  await verdict(page)
    .getByText(/frames/)
    .waitFor();
  const wanted = Number(/\d/.exec((await use.textContent()) ?? '')?.[0]);
  expect(wanted).toBeGreaterThan(1);
  const picture = page.getByText(`1 of ${wanted}`);
  await picture.waitFor();
  await tabTo(page, 'slider', 'Picture');
  await page.keyboard.press('ArrowRight');
  await page.getByText(`2 of ${wanted}`).waitFor();
  await use.click();
  await button(page, 'Change…').waitFor();
  expect(await frames(page).count()).toBe(wanted);
  await saved(page);
  await page.reload();
  await page.getByText('Made from the file walk.gif').waitFor();
  expect(await frames(page).count()).toBe(wanted);
});

test('an animation is undone by one step', async () => {
  const page = await begin();
  const before = await pixels(page);
  await drop(page, { files: { 'walk.gif': gifOf([0, 15, 30]) } });
  await page.getByRole('button', { name: /^Use \d frames$/ }).click();
  await button(page, 'Change…').waitFor();
  await page.keyboard.press('Control+z');
  expect(await pixels(page)).toEqual(before);
  expect(await frames(page).count()).toBe(1);
});

test('several drawings become a frame each', async () => {
  const page = await begin();
  await drop(page, { files: { 'b.svg': HEART, 'a.svg': HEART } });
  await button(page, 'Use 2 frames').click();
  await button(page, 'Change…').waitFor();
  expect(await frames(page).allTextContents()).toEqual([
    expect.stringContaining('a'),
    expect.stringContaining('b'),
  ]);
});
