import { expect, test } from 'vitest';
import { eventually } from './harness';
import {
  button,
  countIs,
  phaseIs,
  pixels,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('a robot is pinned to a pixel from both views, shows it, and is freed again', async () => {
  const page = await bed.open();
  await uploadText(page, 'pins.json', smallShow(6));
  const robots = async () =>
    (await stored(page, 'pins')).frames.map((f) => f.pixels.map((p) => p.robot ?? null));
  await page.getByText('6 robots', { exact: true }).waitFor();
  await page
    .getByRole('button', { name: /^Details of robot/ })
    .last()
    .click();
  const dialog = page.getByRole('dialog', { name: /^Robot / });
  const name = await dialog.locator('dd').first().textContent();
  await dialog.getByLabel('Pinned to pixel (all frames)').first().click();
  await page.getByRole('option', { name: 'Pixel 0' }).click();
  await eventually(robots, (all) => all.every((frame) => frame[0] === name), 'it is pinned');
  await page.keyboard.press('Escape');
  await button(page, 'Play').click();
  await page.getByText(/Playing frame 2 of 2/).waitFor();
  const line = page.getByRole('row').filter({ hasText: name?.slice(0, 8) ?? '' });
  expect(await line.getByRole('cell').first().textContent()).toBe('0');
  await phaseIs(page, 'ready');
  await button(page, 'Details').click();
  await page.getByRole('columnheader', { name: 'Firmware' }).waitFor();
  await page.getByText('Edit', { exact: true }).click();
  await pixelsAre(page, 6);
  await page.keyboard.press(']');
  expect((await pixels(page))[0]?.text).toContain('pinned');
  await page.getByLabel('Pinned robot').first().click();
  await page.getByRole('option', { name: 'None' }).click();
  await saved(page);
  expect((await robots()).flat().every((robot) => robot === null)).toBe(true);
});

test('the checklist says what is missing, Stop all is above it, and one can go on without', async () => {
  const page = await bed.open();
  await uploadText(page, 'eight.json', smallShow(8));
  await button(page, 'Play').click();
  const dialog = page.getByRole('dialog', { name: 'Before you start' });
  await dialog.getByText(/6 of 8 ready: 2 missing/).waitFor();
  expect(await dialog.locator('[data-verdict=good]').count()).toBeGreaterThanOrEqual(3);
  await page.getByTestId('stop-all').click();
  await dialog.getByRole('button', { name: 'Play with 6 robots' }).click();
  await page.getByText(/Playing frame 2 of 2/).waitFor();
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
});

test('the library: pictures, save as, rename, download, delete and undo', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'kept.json', smallShow(6));
  const menu = async (name: string, item: string) => {
    await page.getByRole('button', { name: `What to do with ${name}`, exact: true }).click();
    await page.getByRole('menuitem', { name: item, exact: true }).click();
  };
  const names = () =>
    page.evaluate(async () =>
      ((await (await fetch('/api/shows')).json()) as { name: string }[]).map((e) => e.name),
    );
  await page.getByTestId('open-library').click();
  await page.getByTestId('entry-picture').locator('canvas').first().waitFor();
  await menu('kept', 'Save as…');
  await page.getByRole('dialog').last().getByLabel('Name', { exact: true }).fill('second');
  await button(page, 'Save').click();
  await page.getByTestId('open-library').getByText('second').waitFor();
  await page.getByTestId('open-library').click();
  await menu('second', 'Rename…');
  await page.getByRole('dialog').last().getByLabel('Name', { exact: true }).fill('third');
  await button(page, 'Save').click();
  await page.getByTestId('open-library').getByText('third').waitFor();
  const file = page.waitForEvent('download');
  await menu('third', 'Download');
  expect((await file).suggestedFilename()).toBe('third.lightbots.json');
  await menu('kept', 'Delete');
  await eventually(names, (all) => !all.includes('kept') && all.includes('third'), 'deleted');
  await button(page, 'Undo').last().click();
  await eventually(names, (all) => all.includes('kept') && !all.includes('second'), 'back');
});

test('several frames are chosen, moved, timed, copied and deleted together, and renamed in place', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'strip.json', smallShow(6));
  const cards = page.getByRole('list', { name: 'Frames' }).locator('li > *');
  const names = async () => {
    await saved(page);
    return (await stored(page, 'strip')).frames.map((f) => f.name);
  };
  await cards.nth(1).click();
  await page.keyboard.press('Control+Enter');
  await countIs(cards, 3);
  await page.keyboard.press('F2');
  await page.getByLabel('Name of the frame').fill('Last');
  await page.keyboard.press('Enter');
  expect(await names()).toEqual(['One', 'Two', 'Last']);
  await cards.nth(1).click({ modifiers: ['Shift'] });
  await page.keyboard.press('Alt+PageUp');
  expect(await names()).toEqual(['Two', 'Last', 'One']);
  await page.getByRole('tab', { name: 'Frame' }).click();
  await page.getByLabel(/^Air time/).fill('7');
  await page.keyboard.press('Enter');
  await saved(page);
  const { frames } = await stored(page, 'strip');
  expect(frames.map((f) => f.air_time_s)).toEqual([7, 7, 0.3]);
  await page.getByText('Keep from previous frame', { exact: true }).click();
  await saved(page);
  const identities = (await stored(page, 'strip')).frames.map((f) => f.identity ?? null);
  expect(identities).toEqual(['fixed', 'fixed', null]);
  await page.getByRole('button', { name: /^Duplicate/ }).click();
  await countIs(cards, 5);
  const moment = page.getByRole('slider', { name: 'Moment of the show' });
  await page.getByRole('button', { name: /^Preview/ }).click();
  await eventually(
    async () => Number(await moment.getAttribute('aria-valuenow')),
    (t) => t > 0.4,
    'it is watched without robots',
  );
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: /^Delete/ }).click();
  await countIs(cards, 3);
});

test('settings: unit of lengths, floor, no-go area, robot limits, and the broker', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'floor.json', smallShow(6));
  const settings = async () => {
    await page.getByRole('button', { name: 'Settings' }).click();
    await page.getByRole('dialog').getByTestId('broker').waitFor();
  };
  await settings();
  await page.getByLabel('Units').first().click();
  await page.getByRole('option', { name: 'centimetres' }).click();
  await page
    .getByTestId('broker')
    .getByText(/^Connected to/)
    .waitFor();
  await page.getByText('External', { exact: true }).click();
  await page.getByLabel('Address').fill('no address');
  await button(page, 'Connect').click();
  // The error is shown in the dialog, where the address is corrected, and covers nothing.
  await page
    .getByRole('dialog')
    .getByRole('alert')
    .getByText(/is no broker address/)
    .waitFor();
  await page.getByLabel('Address').fill('mqtt://127.0.0.1:1');
  await button(page, 'Connect').click();
  await page.locator('[data-testid=broker][data-phase=retrying]').waitFor();
  expect(await page.getByTestId('broker').textContent()).toMatch(/trying again\. \S+/);
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await page.locator('[data-testid=broker][data-phase=off]').waitFor();
  await page.getByText('Built-in', { exact: true }).click();
  await button(page, 'Connect').click();
  await page.locator('[data-testid=broker][data-phase=connected]').waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('tab', { name: /^Show/ }).click();
  await page.getByLabel('Width, centimetres').fill('400');
  const before = await pixels(page);
  const many = page.getByLabel('Number of robots');
  await many.fill('');
  await many.pressSequentially('10');
  expect(await pixels(page), 'half a number counts for nothing').toEqual(before);
  await many.press('Enter');
  await pixelsAre(page, 10);
  const placeOf = (all: typeof before) => all.map(({ x, y }) => [x, y]).slice(0, 6);
  expect(placeOf(await pixels(page)), 'who was there stays').toEqual(placeOf(before));
  await many.press('ArrowDown');
  await pixelsAre(page, 9);
  await many.fill('6');
  await many.press('Tab');
  await pixelsAre(page, 6);
  await page.getByRole('button', { name: /^Rectangle/ }).click();
  const stage = await page.getByTestId('stage').boundingBox();
  if (!stage) throw new Error('There is no stage.');
  await page.mouse.move(stage.x + stage.width / 2, stage.y + stage.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(stage.x + stage.width / 2 + 40, stage.y + stage.height * 0.8, { steps: 4 });
  await page.mouse.up();
  await page.getByText('Rectangle 1', { exact: true }).waitFor();
  await page.getByText('Robot size and speed').click();
  await page.getByLabel(/^Speed/).fill('0.2');
  await page.keyboard.press('Enter');
  await saved(page);
  const document = await stored(page, 'floor');
  expect(document.stage.width_m).toBe(4);
  expect(document.stage.obstacles).toHaveLength(1);
  expect(document.stage.robot).toEqual({ speed_mps: 0.2 });
});
