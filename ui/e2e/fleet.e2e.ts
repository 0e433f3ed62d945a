import { expect, test } from 'vitest';
import { findings } from './axe';
import { startRobots } from './harness';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '0');

test('a new robot is let in by the operator, and robots have names that last', async () => {
  const page = await bed.open('live');
  await startRobots(bed.server, 2);
  await page.getByText('2 robots', { exact: true }).waitFor();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('switch', { name: 'Ask before new robots take part' }).focus();
  await page.keyboard.press('Space');
  await page.keyboard.press('Escape');
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  await startRobots(bed.server, 1, ['--seed', '12', '--start', '0.9,1.2']);
  const card = page.getByTestId('incident');
  await card.getByText(/^Robot \S+ is new and wants to join\./).waitFor();
  const table = page.getByRole('table');
  await table.getByText('not listed').waitFor();
  expect(await findings(page)).toEqual([]);
  await card.getByRole('button', { name: 'Let it join' }).click();
  await table.getByText('not listed').waitFor({ state: 'detached' });
  await card.getByText('That is over.').waitFor();

  await page
    .getByRole('button', { name: /^Details of robot/ })
    .first()
    .click();
  const dialog = page.getByRole('dialog');
  await dialog.getByLabel('What you call it').fill('Anna');
  await dialog.getByRole('button', { name: 'Save name' }).click();
  await page.getByRole('dialog', { name: 'Robot Anna' }).waitFor();
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });
  await page.keyboard.press('/');
  await page.keyboard.type('ann');
  await table.getByText('Anna', { exact: true }).waitFor();
  expect(await table.getByRole('row').count()).toBe(2);
  await page.getByRole('searchbox').fill('');
  await table.getByRole('button', { name: 'Robot', exact: true }).click();
  await table
    .getByRole('columnheader', { name: 'Robot' })
    .and(page.locator('[aria-sort=ascending]'))
    .waitFor();

  await bed.server.kill();
  await bed.server.restart();
  await startRobots(bed.server, 1, ['--seed', '12', '--start', '0.9,1.2']);
  await table.getByText('Anna', { exact: true }).waitFor();
});
