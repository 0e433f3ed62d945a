import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  button,
  drag,
  onScreen,
  openShow,
  phaseIs,
  pixels,
  pixelsAre,
  saved,
  smallShow,
  stored,
  tabTo,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

interface StoredLayer {
  name?: string;
  kind: string;
  frames?: string[];
  phase?: string;
  settings: Record<string, unknown>;
}

const layers = async (page: Page, show: string) =>
  ((await stored(page, show)) as unknown as { layers?: StoredLayer[] }).layers ?? [];

const layersAre = (page: Page, show: string, wanted: (found: StoredLayer[]) => boolean) =>
  eventually(() => layers(page, show), wanted, 'the layers are saved');

/** Red, green and blue, 0 to 255, of the stage at the place of the first pixel. */
async function lightOf(page: Page): Promise<number[]> {
  const [first] = await pixels(page);
  if (!first) throw new Error('There is no pixel.');
  const at = await onScreen(page, first.x, first.y);
  return page.evaluate(({ x, y }) => {
    const canvas = document.querySelector('[data-testid=stage] canvas') as HTMLCanvasElement;
    const box = canvas.getBoundingClientRect();
    const density = canvas.width / box.width;
    const [left, top] = [(x - box.x) * density, (y - box.y) * density];
    return [...(canvas.getContext('2d')?.getImageData(left, top, 1, 1).data ?? [])].slice(0, 3);
  }, at);
}

const isLit = (wanted: (colour: readonly number[]) => boolean, page: Page, what: string) =>
  eventually(() => lightOf(page), wanted, what);

const [isGreen, isRed] = [
  ([r = 0, g = 0]: readonly number[]) => g > r + 60,
  ([r = 0, g = 0]: readonly number[]) => r > g + 60,
];

async function begin(page: Page, name: string) {
  await uploadText(page, `${name}.json`, smallShow(6, 2));
  await pixelsAre(page, 6);
  await page.getByRole('tab', { name: 'Light' }).click();
}

const preset = (page: Page, title: string) =>
  page.getByRole('list', { name: 'Presets of light' }).getByRole('button', { name: title });
const layer = (page: Page, title: string) =>
  page
    .getByRole('list', { name: 'Layers, the uppermost first' })
    .getByRole('button', { name: new RegExp(`^${title}`) });

test('a preset shines on the stage at once, is changed in the panel and is saved', async () => {
  const page = await bed.open('edit');
  await begin(page, 'shine');
  await preset(page, 'Starry').click();
  await page.getByRole('combobox', { name: 'Effect' }).click();
  await page.getByRole('option', { name: 'Plain colour' }).click();
  await page.getByRole('combobox', { name: 'Mixing' }).click();
  await page.getByRole('option', { name: 'Covers what is below' }).click();
  const colour = page.getByRole('textbox', { name: 'Colour 1 of the layer' });
  await colour.fill('#00ff00');
  await colour.press('Tab');
  await isLit(isGreen, page, 'the robots are green');
  await colour.fill('#ff0000');
  await colour.press('Tab');
  await isLit(isRed, page, 'the robots are red');
  await page.keyboard.press('Control+z');
  await isLit(isGreen, page, 'the robots are green again');
  await saved(page);
  await layersAre(page, 'shine', ([only]) => {
    const palette = only?.settings.palette as string[] | undefined;
    return only?.kind === 'solid' && palette?.[0] === '#00ff00';
  });
  // The layer lights only the second frame. The colours of the stage are those of the moment that it shows.
  await page.getByText('Frames', { exact: true }).last().click();
  await page.getByRole('combobox', { name: 'To frame' }).click();
  await page.getByRole('option', { name: /^2/ }).click();
  await page.getByRole('combobox', { name: 'From frame' }).click();
  await page.getByRole('option', { name: /^2/ }).click();
  await isLit((now) => !isGreen(now), page, 'the first frame has its own colours');
  await button(page, /^2/).first().click();
  await isLit(isGreen, page, 'the second frame is green');
  await layersAre(page, 'shine', ([only]) => only?.frames?.join() === 'f2,f2');
  await page.close();
});

test('a layer shines on a part of the floor or on chosen pixels, and changes over time', async () => {
  const page = await bed.open('edit');
  await begin(page, 'parts');
  await preset(page, 'Starry').click();
  const choose = async (field: string, option: string) => {
    await page.getByRole('combobox', { name: field }).click();
    await page.getByRole('option', { name: option }).click();
  };
  await choose('Effect', 'Plain colour');
  await choose('Mixing', 'Covers what is below');
  const colour = page.getByRole('textbox', { name: 'Colour 1 of the layer' });
  await colour.fill('#00ff00');
  await colour.press('Tab');
  await isLit(isGreen, page, 'all robots are green');
  const isOwn = (what: string) => isLit((now) => !isGreen(now), page, what);
  await choose('Shines on', 'A circle on the floor');
  await isOwn('the first robot stands outside of the circle');
  const radius = page.getByRole('textbox', { name: /^Radius/ });
  await radius.fill('200');
  await radius.press('Enter');
  await isLit(isGreen, page, 'the circle holds the first robot');
  await page.getByRole('checkbox', { name: 'Everywhere else instead' }).click();
  await isOwn('all but the circle shines');
  await choose('Shines on', 'Some pixels');
  await page.getByText('Choose pixels on the floor').waitFor();
  await drag(page, [-0.9, 1.35], [0.6, 0.95]);
  await button(page, 'Take the chosen').click();
  await isLit(isGreen, page, 'the chosen pixels are green');
  await button(page, 'Let it change over time').click();
  // The picture on the stage is that of two seconds after the start.
  const later = page.getByRole('textbox', { name: /^Opacity/ }).last();
  await later.fill('0');
  await later.press('Enter');
  await isOwn('the layer is dark');
  await layersAre(page, 'parts', ([only]) => {
    const [mask] = (only?.settings.masks as { shape: string; pixels: number[] }[]) ?? [];
    const opacity = JSON.stringify(only?.settings.opacity);
    return mask?.shape === 'pixels' && mask.pixels.length === 6 && opacity === '[[0,0],[2,0]]';
  });
  await later.fill('100');
  await later.press('Enter');
  await isLit(isGreen, page, 'the layer is bright again');
  await button(page, 'Take out point 1').click();
  await button(page, 'Make it even').click();
  await layersAre(page, 'parts', ([only]) => only?.settings.opacity === 1);
  await page.close();
});

test('handles on the floor move a layer, and Escape takes a drag back', async () => {
  const page = await bed.open('edit');
  await begin(page, 'handles');
  await preset(page, 'Rainbow').click();
  await drag(page, [-1.5, 0], [-1, 0.5]);
  await layersAre(page, 'handles', ([only]) => {
    const [x = 0, y = 0] = (only?.settings.place as number[] | undefined) ?? [];
    return Math.abs(x + 1) < 0.02 && Math.abs(y - 0.5) < 0.02;
  });
  await drag(page, [1.99, 0.5], [0, 0.5]);
  await layersAre(page, 'handles', ([only]) => Math.abs(Number(only?.settings.size_m) - 1) < 0.03);
  const before = await layers(page, 'handles');
  const from = await onScreen(page, -1, 0.5);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 60, from.y + 60, { steps: 3 });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await saved(page);
  expect(await layers(page, 'handles')).toEqual(before);
  await page.close();
});

test('layers are added, ordered, copied and deleted with the keyboard alone', async () => {
  const page = await bed.open('edit');
  await begin(page, 'keys');
  await tabTo(page, 'button', 'Fire');
  await page.keyboard.press('Enter');
  await tabTo(page, 'button', 'Add light');
  await page.keyboard.press('Enter');
  await tabTo(page, 'button', 'Chase');
  await page.keyboard.press('Enter');
  const names = (found: StoredLayer[]) => found.map((one) => one.name).join();
  await layersAre(page, 'keys', (found) => names(found) === 'Fire,Chase');
  await layer(page, 'Chase').focus();
  await page.keyboard.press('Alt+ArrowDown');
  await layersAre(page, 'keys', (found) => names(found) === 'Chase,Fire');
  await button(page, 'Duplicate Fire').focus();
  await page.keyboard.press('Enter');
  await layersAre(page, 'keys', (found) => names(found) === 'Chase,Fire,Fire');
  await layer(page, 'Chase').focus();
  await page.keyboard.press('Delete');
  await layersAre(page, 'keys', (found) => names(found) === 'Fire,Fire');
  await page.close();
});

test('a show with light is run from the editor', async () => {
  const page = await bed.open('edit');
  await begin(page, 'strobe');
  await preset(page, 'Slow strobe').click();
  await saved(page);
  await openShow(page, 'strobe');
  await button(page, 'Run on robots').click();
  await phaseIs(page, 'playing');
  await phaseIs(page, 'ready');
  await page.close();
});

/** A GIF of one green pixel. */
const GREEN_GIF = Buffer.from(
  'GIF89a\x01\0\x01\0\x80\0\0\0\xff\0\0\0\0,\0\0\0\0\x01\0\x01\0\0\x02\x02D\x01\0;',
  'latin1',
);

test('a picture of a file shines on the floor, and a damaged one is said at its layer', async () => {
  const page = await bed.open('edit');
  await begin(page, 'projected');
  const file = (name: string, buffer: Buffer) => ({ name, mimeType: 'image/gif', buffer });
  const added = page.locator('input[type=file][aria-label="File of a picture or film"]');
  await added.setInputFiles(file('meadow.gif', GREEN_GIF));
  await isLit(isGreen, page, 'the robots are green');
  await layersAre(
    page,
    'projected',
    ([only]) => only?.name === 'meadow' && String(only.settings.picture).length === 64,
  );
  const chosen = page.locator('input[type=file][aria-label="File of the picture"]');
  await chosen.setInputFiles(file('torn.gif', GREEN_GIF.subarray(0, 22)));
  await page.getByText('damaged or cut off').first().waitFor();
  await page.getByRole('combobox', { name: 'Picture' }).click();
  await page.getByRole('option', { name: 'meadow.gif' }).click();
  await isLit(isGreen, page, 'the robots are green again');
  await page.close();
});
