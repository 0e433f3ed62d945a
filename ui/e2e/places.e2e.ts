import { expect, test } from 'vitest';
import { findings } from './axe';
import { eventually, startRobots } from './harness';
import { button, phaseIs, smallShow, stored, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '0');

test('robots are compared with the starting places, and their layout is taken or they drive home', async () => {
  const page = await bed.open('live');
  await startRobots(bed.server, 3, ['--seed', '11', '--start', '-0.5,0 0,0 0.5,0']);
  await page.getByText('3 robots', { exact: true }).waitFor();
  await uploadText(page, 'places.json', smallShow(3));
  await phaseIs(page, 'ready');
  const open = () => button(page, 'Places…').click();
  const dialog = page.getByRole('dialog', { name: 'Compare places' });
  await open();
  await dialog.getByText('0 of 3 robots in their starting places, 3 elsewhere.').waitFor();
  expect(await dialog.getByRole('listitem').count()).toBe(3);
  expect(await findings(page)).toEqual([]);
  if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/places.png` });

  await dialog.getByRole('button', { name: 'Take this layout' }).click();
  await dialog.waitFor({ state: 'hidden' });
  await eventually(
    () => stored(page, 'places') as Promise<unknown> as Promise<{ starts?: number[][] }>,
    ({ starts }) => starts?.length === 3 && starts.every(([, y = 9]) => Math.abs(y) < 0.02),
    'the show starts where robots stand',
  );
  await open();
  await dialog.getByText('3 of 3 robots in their starting places.').waitFor();
  expect(await dialog.getByRole('button', { name: 'Home' }).isDisabled()).toBe(true);
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });

  await button(page, 'Play').click();
  await page.getByText('Playing frame 2 of 2').waitFor();
  await phaseIs(page, 'ready');
  await open();
  await dialog.getByText('0 of 3 robots in their starting places, 3 elsewhere.').waitFor();
  await dialog.getByRole('button', { name: 'Home' }).click();
  await page.getByText('Driving home').waitFor();
  await phaseIs(page, 'ready');
  await open();
  await dialog.getByText('3 of 3 robots in their starting places.').waitFor();
});
