import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { findings } from './axe';
import { openPage, startServer, type Server } from './harness';
import { button, pixelsAre, smallShow, stored, uploadText } from './journeys';
import { openAs, startSignInServer } from './signedIn';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');
let other: Server;
beforeAll(async () => {
  other = await startServer('--robots', '6');
});
afterAll(() => other.remove());

const SHOTS = process.env.SHOTS;
const shoot = async (page: Page, name: string) => {
  if (!SHOTS) return;
  await page.screenshot({ path: `${SHOTS}/share-${name}-${page.viewportSize()?.width}.png` });
};

const HASH = 'a'.repeat(64);

/** A show that lists two files, which nothing in it uses. */
const showWithFiles = () =>
  JSON.stringify({
    ...(JSON.parse(smallShow(6)) as object),
    lightbots: 2,
    name: 'Grüße',
    assets: {
      [HASH]: { name: 'flag.png', media_type: 'image/png', bytes: 100 },
      [HASH.replace(/a/g, 'b')]: { name: 'song.mp3', media_type: 'audio/mpeg', bytes: 1000 },
    },
  });

/** Uploads a show in the editor, and opens the dialog with its link. */
async function openLink(page: Page, name: string, text: string) {
  await uploadText(page, `${name}.json`, text);
  await pixelsAre(page);
  await button(page, 'Download or copy the show').click();
  await page.getByRole('menuitem', { name: 'Copy a link to this show' }).click();
  const dialog = page.getByRole('dialog', { name: 'A link to this show' });
  await dialog.waitFor();
  return dialog;
}

const names = (page: Page) =>
  page.evaluate(async () =>
    ((await (await fetch('/api/shows')).json()) as { name: string }[]).map(({ name }) => name),
  );

/** Opens the packed show of a link on `server`. */
async function follow(page: Page, server: Server, link: string) {
  await page.goto(`${server.url}/${new URL(link).hash}`);
  await page.getByRole('button', { name: 'Leave' }).waitFor();
}

test('a link opens the same show on another installation, and saves nothing before', async () => {
  const page = await bed.open('edit');
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  const dialog = await openLink(page, 'greeting', showWithFiles());
  await dialog.getByText('without its 2 files').waitFor();
  await dialog.getByText('flag.png, song.mp3').waitFor();
  expect(await findings(page)).toEqual([]);
  await shoot(page, 'dialog');
  await button(page, 'Copy the link').click();
  await page.getByText('Link copied.').waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link.startsWith(`${bed.server.url}/#/shared/`)).toBe(true);

  const second = await openPage(bed.browser, other);
  const before = await names(second);
  await follow(second, other, link);
  await second.getByRole('heading', { name: 'Grüße' }).waitFor();
  await second.getByText('6 robots, 2 frames').waitFor();
  await second.getByText('Its 2 files did not come with it.').waitFor();
  expect(await findings(second)).toEqual([]);
  for (const [width, height] of [
    [1440, 900],
    [1024, 768],
    [390, 844],
  ] as const) {
    await second.setViewportSize({ width, height });
    const wide = await second.evaluate(() => document.documentElement.scrollWidth);
    expect(wide).toBeLessThanOrEqual(width);
    await shoot(second, 'page');
  }
  await second.setViewportSize({ width: 1440, height: 900 });
  expect(await names(second)).toEqual(before);
  await button(second, 'Open as a new show').click();
  await pixelsAre(second, 6);
  expect(second.url()).toMatch(/#\/edit\/Gr/);
  const [sent, got] = [await stored(page, 'greeting'), await stored(second, 'Grüße')];
  expect(got).toEqual(sent);
  // When the link is opened again, the name is taken.
  await follow(second, other, link);
  await button(second, 'Open as a new show').click();
  await pixelsAre(second, 6);
  expect(await names(second)).toContain('Grüße 2');
  await second.close();
});

test('a link that was cut off, or holds no show, is refused and nothing is lost', async () => {
  const page = await bed.open('edit');
  const dialog = await openLink(page, 'cut', smallShow(6));
  const link = await dialog.getByRole('textbox', { name: 'Link' }).inputValue();
  await page.keyboard.press('Escape');
  const before = await names(page);
  for (const wrong of [
    link.slice(0, -40),
    `${link}%20oh`,
    `${link.split('shared/')[0]}shared/qrs`,
  ]) {
    await follow(page, bed.server, wrong);
    await page.getByText(/damaged or was cut off/).waitFor();
    expect(await button(page, 'Open as a new show').count()).toBe(0);
  }
  expect(await findings(page)).toEqual([]);
  await shoot(page, 'refused');
  await button(page, 'Leave').click();
  await page.getByTestId('phase').waitFor();
  expect(await names(page)).toEqual(before);
});

test('a show that is too large for a link is to be saved as a file', async () => {
  const page = await bed.open('edit');
  const show = JSON.parse(smallShow(1)) as { frames: { pixels: object[] }[] };
  // Random places and colours, which compression hardly shortens.
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const pixels = Array.from({ length: 900 }, (_, id) => ({
    id,
    place: [random() * 2.8 - 1.4, random() * 2.8 - 1.4].map((m) => Math.round(m * 1e4) / 1e4),
    color: `#${Math.floor(random() * 0xffffff)
      .toString(16)
      .padStart(6, '0')}`,
  }));
  const frames = [0, 1, 2, 3].map(() => ({ ...show.frames[0], pixels }));
  const dialog = await openLink(page, 'large', JSON.stringify({ ...show, frames: mixed(frames) }));
  await dialog.getByText(/too large for a link/).waitFor();
  expect(await button(page, 'Copy the link').count()).toBe(0);
  expect(await findings(page)).toEqual([]);
});

/** Gives the pixels of each frame places in another order, so that no frame is packed as a reference to another. */
const mixed = <T extends { pixels: { place: number[] }[] }>(frames: T[]) =>
  frames.map((frame, shift) => ({
    ...frame,
    pixels: frame.pixels.map((pixel, i) => ({
      ...pixel,
      place: frame.pixels[(i * (2 * shift + 1)) % frame.pixels.length]?.place,
    })),
  }));

test('a viewer sees what the show is, and that an editor must open it', async () => {
  const page = await bed.open('edit');
  const dialog = await openLink(page, 'for viewers', smallShow(6));
  const link = await dialog.getByRole('textbox', { name: 'Link' }).inputValue();
  const server = await startSignInServer('--robots', '2');
  try {
    const viewer = await openAs(bed.browser, server, 'viewer');
    await follow(viewer, server, link);
    await viewer.getByText('6 robots, 2 frames').waitFor();
    await viewer
      .getByRole('note')
      .getByText('Your role is viewer. An editor can open it as a new show.')
      .waitFor();
    expect(await button(viewer, 'Open as a new show').isDisabled()).toBe(true);
    expect(await findings(viewer)).toEqual([]);
    await viewer.close();
    const editor = await openAs(bed.browser, server, 'editor');
    await follow(editor, server, link);
    await button(editor, 'Open as a new show').click();
    await pixelsAre(editor, 6);
    await editor.close();
  } finally {
    await server.remove();
  }
});
