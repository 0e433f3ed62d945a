import { readFile } from 'node:fs/promises';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import { button, pixels, pixelsAre, saved, uploadText } from './journeys';
import { originalShow, type OriginalFrame } from './originalShow';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '0');

/** The show as the original's editor would load it, from the download menu. */
async function exported(page: Page): Promise<OriginalFrame[]> {
  await page.getByRole('button', { name: 'Download or copy the show' }).click();
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('menuitem', { name: /original LightBots/ }).click(),
  ]);
  return JSON.parse(await readFile(await download.path(), 'utf8')) as OriginalFrame[];
}

/** The parts of a show that have a meaning, with the pixels sorted by id. */
const meaning = (frames: OriginalFrame[]) =>
  frames.map(({ name, airTime, pixels }) => ({
    name,
    airTime,
    pixels: [...pixels]
      .sort((a, b) => a.pixelId - b.pixelId)
      .map(({ pixelId, physicalLocation, color }) => ({ pixelId, physicalLocation, color })),
  }));

test('a show of the original: one colour changed, saved, reloaded, exported; all else is as it was', async () => {
  const original = originalShow();
  const page = await bed.open('edit');
  await uploadText(page, 'rings.json', JSON.stringify(original));
  await pixelsAre(page, 30);
  expect(meaning(await exported(page))).toEqual(meaning(original));

  await page.getByRole('list', { name: 'Frames' }).getByRole('button').nth(4).click();
  await page.keyboard.press(']');
  await eventually(
    () => pixels(page),
    (all) => all[0]?.chosen === true,
    'pixel 0 is chosen',
  );
  await button(page, 'Colour pink #ff2f92').click();
  await saved(page);
  await page.reload();
  await pixelsAre(page, 30);

  const wanted = meaning(original);
  const changed = wanted[4]?.pixels[0];
  if (!changed) throw new Error('There is no such pixel.');
  changed.color = { R: 1, G: Math.fround(0x2f / 255), B: Math.fround(0x92 / 255) };
  const found = await exported(page);
  expect(meaning(found)).toEqual(wanted);
  // The original loads a file only if the state of its editor is in it too.
  const keys = (frames: OriginalFrame[]) => Object.keys(frames[4]?.pixels[0] ?? {}).sort();
  expect(keys(found)).toEqual(keys(original));
});
