import { expect, test } from 'vitest';
import { findings } from './axe';
import { startRobots } from './harness';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '0');

test('a robot that dies is an incident with cause and remedy on every screen until it is read', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'loses.json', smallShow(5, 20));
  await startRobots(bed.server, 4);
  const end = await startRobots(bed.server, 1, ['--seed', '12', '--start', '0.9,1.2']);
  await page.getByText('5 robots', { exact: true }).waitFor();
  await button(page, 'Play').click();
  await phaseIs(page, 'playing');
  await page.getByText('Playing frame 1 of 2').waitFor();
  await end();
  const card = page.getByTestId('incident');
  await card.getByText(/^Robot \S+ fell silent in frame [12] – its pixel is left dark\./).waitFor();
  expect(await card.textContent()).toContain('The others go on without it');
  expect(await card.textContent()).toContain('its battery is charged');
  await card.getByRole('button', { name: /^Find robot \S+$/ }).click();
  expect(await findings(page)).toEqual([]);

  const small = await bed.open('live');
  await small.setViewportSize({ width: 390, height: 844 });
  const banner = small.getByTestId('incident-banner');
  await banner.getByText('fell silent').waitFor();
  const box = await banner.boundingBox();
  expect(box && box.y + box.height).toBeLessThan(320);
  await banner.getByRole('button', { name: 'Got it' }).click();
  await banner.waitFor({ state: 'detached' });
  await page.getByText('1 earlier').waitFor();
  await page.getByText('1 earlier').click();
  await card.getByText('fell silent').waitFor();
  expect(await card.getByRole('button').count()).toBe(0);
});
