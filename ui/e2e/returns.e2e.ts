import { expect, test } from 'vitest';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '3', '--on-return', 'ask');

test('a show whose program was killed asks whether it goes on, and does or is over', async () => {
  const page = await bed.open();
  await uploadText(page, 'killed.json', smallShow(3, 30));
  await page.getByText('3 robots', { exact: true }).waitFor();
  await button(page, 'Play').click();
  await phaseIs(page, 'playing');
  await bed.server.kill();
  await bed.server.restart();
  const question = page.getByRole('alert').filter({ hasText: 'The show was interrupted' });
  await question.getByRole('button', { name: 'Go on' }).click();
  await question.waitFor({ state: 'detached' });
  await phaseIs(page, 'playing');
  await page.getByTestId('open-library').getByText('killed').waitFor();

  await bed.server.kill();
  await bed.server.restart();
  // A screen that is opened later shows the question, too.
  const second = await bed.open();
  await second.getByRole('alert').getByRole('button', { name: 'Stop' }).click();
  await phaseIs(page, 'ready');
  expect(await question.count()).toBe(0);
});
