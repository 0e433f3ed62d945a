import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { eventually } from './harness';
import { focusByTab } from './hand';
import { button, pixelsAre, saved, smallShow, stored, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '12');

/** The parts of a stored show that these tests check. */
interface StoredTimes {
  lightbots: number;
  frames: { air_time_s: number; transition_s?: number }[];
  markers?: { name: string; at_s: number }[];
  sections?: { name: string; from_s: number; to_s: number }[];
  cues?: unknown[];
  layers?: { from_s?: number; to_s?: number; frames?: string[] }[];
}
const times = async (page: Page, name: string) =>
  (await stored(page, name)) as unknown as StoredTimes;

const blocks = (page: Page) =>
  page.getByRole('listbox', { name: 'Frames on the timeline' }).getByRole('option');
const markers = (page: Page) => page.getByRole('listbox', { name: 'Markers' });

/** The least and the present travel time that a block names, seconds. */
async function drives(page: Page, nth: number): Promise<{ least_s: number; travel_s: number }> {
  const text = (await blocks(page).nth(nth).getAttribute('title')) ?? '';
  const travel_s = Number(/drive ([\d.]+) s/.exec(text)?.[1]);
  const least = /at least ([\d.]+) s/.exec(text)?.[1];
  return { travel_s, least_s: least === undefined ? travel_s : Number(least) };
}

/** Uploads a show of two frames, with `more` in its document; shows the timeline and waits for the plan. */
async function begin(page: Page, name: string, more: object = {}): Promise<void> {
  const show = { ...(JSON.parse(smallShow(12, 2)) as object), ...more };
  await uploadText(page, `${name}.json`, JSON.stringify(show));
  await pixelsAre(page, 12);
  await button(page, 'Timeline (L)').click();
  await page.getByRole('option', { name: /^Frame 2 Two: drive [\d.]+ s/ }).waitFor();
}

/** Drags with the mouse from the middle of the first element that matches, `by_px` CSS pixels to the right. */
async function dragBy(page: Page, selector: string, by_px: number) {
  const box = await page.locator(selector).first().boundingBox();
  if (!box) throw new Error(`There is no ${selector}.`);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by_px / 2, y, { steps: 4 });
  await page.mouse.move(x + by_px, y, { steps: 4 });
  await page.mouse.up();
}

describe('the timeline', () => {
  test('edges, the least travel time, a marker, and undo of all of it', async () => {
    const page = await bed.open('edit');
    await begin(page, 'edges');
    const before = await times(page, 'edges');
    expect(before.lightbots).toBe(1);

    await dragBy(page, '[data-frame="0"] [data-edge=air]', 80);
    await saved(page);
    const longer = (await times(page, 'edges')).frames.map((f) => f.air_time_s);
    expect(longer[0]).toBeGreaterThan(2.5);
    expect(longer[1]).toBe(2);

    await dragBy(page, '[data-frame="1"] [data-edge=travel]', 60);
    await saved(page);
    const slow_s = (await times(page, 'edges')).frames[1]?.transition_s ?? 0;
    const { least_s } = await drives(page, 1);
    expect(slow_s).toBeGreaterThan(least_s);
    await dragBy(page, '[data-frame="1"] [data-edge=travel]', -500);
    await page.getByRole('status').getByText('the least').waitFor();
    await saved(page);
    expect((await times(page, 'edges')).frames[1]?.transition_s).toBeUndefined();
    const { travel_s } = await drives(page, 1);
    expect(travel_s).toBeGreaterThanOrEqual(least_s);

    await button(page, 'Add a marker here').click();
    await page.getByLabel('Name of the marker').fill('Drum');
    await page.keyboard.press('Enter');
    await saved(page);
    const [at] = (await times(page, 'edges')).markers ?? [];
    expect(at?.name).toBe('Drum');
    await dragBy(page, '[role=option][data-index="0"]', 50);
    await saved(page);
    const [moved] = (await times(page, 'edges')).markers ?? [];
    expect(moved?.at_s).toBeGreaterThan((at?.at_s ?? 0) + 0.5);

    // Air time, travel time twice, adding, naming and moving the marker: one step each.
    for (let i = 0; i < 6; i++) await page.keyboard.press('Control+z');
    expect(await button(page, 'Undo (Ctrl Z)').isDisabled()).toBe(true);
    await saved(page);
    const after = await times(page, 'edges');
    expect(after.frames).toEqual(before.frames);
    expect(after.markers).toBeUndefined();
    // The document is of version 1 as before; only the show's name, which every save writes, may differ.
    expect(after.lightbots).toBe(1);
  });

  test('by keyboard alone', async () => {
    const page = await bed.open('edit');
    await begin(page, 'keys');
    const list = page.getByRole('listbox', { name: 'Frames on the timeline' });
    await focusByTab(page, list);
    await page.keyboard.press('ArrowRight');
    await page.getByRole('option', { name: /^Frame 2/, selected: true }).waitFor();
    await page.keyboard.press('Shift+ArrowLeft');
    await page.keyboard.press(']');
    await page.keyboard.press('Alt+]');
    await page.keyboard.press('c');
    await saved(page);
    const stretched = await times(page, 'keys');
    expect(stretched.frames.map((f) => f.air_time_s)).toEqual([2.6, 2.6]);
    expect(stretched.cues).toHaveLength(2);
    await page.keyboard.press('Shift+]');
    await eventually(
      async () => (await drives(page, 1)).travel_s - (await drives(page, 1)).least_s,
      (more_s) => more_s > 0.3,
      'the drive takes longer than it must',
    );
    for (let i = 0; i < 4; i++) await page.keyboard.press('Shift+[');
    expect(await drives(page, 1)).toEqual({
      travel_s: (await drives(page, 1)).least_s,
      least_s: (await drives(page, 1)).least_s,
    });

    await focusByTab(page, button(page, 'Add a marker here'));
    await page.keyboard.press('Enter');
    await page.keyboard.type('Bell');
    await page.keyboard.press('Enter');
    await page.getByRole('option', { name: /^Marker Bell at/ }).waitFor();
    await page.keyboard.press('.');
    await page.keyboard.press('Enter');
    await page.keyboard.type('Gong');
    await page.keyboard.press('Enter');
    await page.getByRole('option', { name: /^Marker Gong at/ }).waitFor();
    await saved(page);
    expect((await times(page, 'keys')).markers?.[0]).toMatchObject({ name: 'Gong' });
    await page.keyboard.press('Delete');
    await markers(page).waitFor({ state: 'detached' });
    await saved(page);
    expect((await times(page, 'keys')).markers).toBeUndefined();
  });

  test('several frames, a section, a layer, and a press on the ruler', async () => {
    const page = await bed.open('edit');
    const layers = [{ kind: 'pulse', from_s: 1, to_s: 4 }];
    await begin(page, 'several', { lightbots: 2, layers, beats: { bpm: 120 } });
    await page.getByTestId('timeline').getByText('Beats', { exact: true }).waitFor();
    const lane = await page.getByRole('listbox', { name: 'Frames on the timeline' }).boundingBox();
    const [first, second] = [await box(page, 0), await box(page, 1)];
    if (!lane) throw new Error('There are no frames.');
    await page.mouse.move(first.x + 20, first.y + 30);
    await page.mouse.down();
    await page.mouse.move(second.x + 30, first.y + 30, { steps: 5 });
    await page.mouse.up();
    expect(await page.getByRole('option', { name: /^Frame/, selected: true }).count()).toBe(2);
    await button(page, 'Add a section over the chosen frames').click();
    await page.keyboard.press('Escape');
    await dragBy(page, '[data-frame="1"] [data-edge=air]', 60);
    await dragBy(page, '[data-layer="0"] [data-part=to]', 70);
    await saved(page);
    const now = await times(page, 'several');
    const [a = 0, b = 0] = now.frames.map((f) => f.air_time_s);
    expect(a).toBeGreaterThan(2);
    expect(a).toBe(b);
    expect(now.sections?.[0]?.name).toBe('Section 1');
    expect(now.layers?.[0]?.to_s).toBeGreaterThan(4.5);

    const moment = page.getByRole('slider', { name: 'Moment of the show' });
    const ruler = await page.getByTestId('timeline-ruler').boundingBox();
    if (!ruler) throw new Error('There is no ruler.');
    await page.mouse.click(second.x + 4, ruler.y + 8);
    await eventually(
      async () => Number(await moment.getAttribute('aria-valuenow')),
      (at_s) => at_s > 2,
      'the ruler moves the playhead',
    );
    // After loading again, the page still shows the timeline.
    await page.reload();
    await blocks(page).first().waitFor();
  });
});

async function box(page: Page, nth: number) {
  const found = await blocks(page).nth(nth).boundingBox();
  if (!found) throw new Error(`There is no block ${nth}.`);
  return found;
}
