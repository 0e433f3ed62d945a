import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { findings } from './axe';
import { button, pixelsAre, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '4');

async function openDialog(name: string) {
  const page = await bed.open('edit');
  await uploadText(page, `${name}.json`, smallShow(4, 2));
  await pixelsAre(page, 4);
  await button(page, 'Download or copy the show').click();
  await page.getByRole('menuitem', { name: 'Make a film…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Film of the show' });
  await dialog
    .getByRole('button', { name: 'Make the film' })
    .and(page.locator(':enabled'))
    .waitFor();
  return { page, dialog };
}

/** Loads a film in the page: size, duration, seconds, and brightest component, 0 to 255, a second before its end. */
const looked = (page: Page, type: string, film: Buffer) =>
  page.evaluate(
    async ({ type, text }) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const video = document.createElement('video');
      video.src = URL.createObjectURL(new Blob([bytes], { type }));
      await new Promise((done, fail) => {
        video.onloadeddata = done;
        video.onerror = () => fail(new Error('the film cannot be played'));
      });
      const seek = new Promise((done) => (video.onseeked = done));
      video.currentTime = video.duration - 1;
      await seek;
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
      const draw = canvas.getContext('2d');
      draw?.drawImage(video, 0, 0);
      const data = draw?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      let brightest = 0;
      for (let i = 0; i < data.length; i += 4)
        brightest = Math.max(brightest, data[i] ?? 0, data[i + 1] ?? 0, data[i + 2] ?? 0);
      const { videoWidth: width, videoHeight: height, duration } = video;
      return { width, height, duration, brightest };
    },
    { type, text: film.toString('base64') },
  );

test.each([
  ['mp4', 'MP4 (H.264)'],
  ['webm', 'WebM (VP9)'],
] as const)('a film of the show is made as %s and plays', async (kind, label) => {
  const { page, dialog } = await openDialog(`film ${kind}`);
  expect(await findings(page)).toEqual([]);
  await dialog.getByRole('combobox', { name: 'File' }).click();
  await page.getByRole('option', { name: label }).click();
  const download = page.waitForEvent('download');
  await dialog.getByRole('button', { name: 'Make the film' }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe(`film ${kind}.${kind}`);
  await dialog.getByText(/The film is saved: \d+\.\d MB/).waitFor();
  const film = await looked(page, `video/${kind}`, readFileSync(await file.path()));
  expect([film.width, film.height]).toEqual([1280, 720]);
  expect(film.duration).toBeGreaterThan(5);
  expect(film.brightest).toBeGreaterThan(150);
});

test('a film on its way is cancelled, and another one is made', async () => {
  const { dialog } = await openDialog('cancelled');
  await dialog.getByRole('button', { name: 'Make the film' }).click();
  await dialog.getByText(/Painting: [1-9]/).waitFor();
  await dialog.getByRole('button', { name: 'Cancel' }).click();
  await dialog.getByRole('button', { name: 'Make the film' }).click();
  await dialog.getByText(/Painting: [1-9]/).waitFor();
  await dialog.getByRole('button', { name: 'Cancel' }).click();
  await dialog.getByRole('button', { name: 'Close' }).last().click();
  await dialog.waitFor({ state: 'detached' });
});

test('a first film of a show of one’s own takes four clicks', async () => {
  const page = await bed.open('live');
  await page.evaluate(() => {
    const counted = globalThis as unknown as { clicks: number };
    counted.clicks = 0;
    addEventListener('click', (event) => (counted.clicks += event.detail > 0 ? 1 : 0), true);
  });
  await button(page, 'New').click();
  await page.getByRole('textbox', { name: 'Words to show' }).fill('HI');
  await page.getByRole('textbox', { name: 'Words to show' }).press('Enter');
  await page.getByText('Made from the words “HI”').waitFor();
  await button(page, 'Download or copy the show').click();
  await page.getByRole('menuitem', { name: 'Make a film…' }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Make the film' }).click();
  expect((await download).suggestedFilename()).toMatch(/^HI\.(mp4|webm)$/);
  const clicks = await page.evaluate(() => (globalThis as unknown as { clicks: number }).clicks);
  expect(clicks).toBe(4);
});
