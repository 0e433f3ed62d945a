import { expect, test } from 'vitest';
import { startRobots } from './harness';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '0');

// Two robots: three or more that fall silent at once count as a lost link, and the show would wait for them.
test('a run whose robots all die says so where Play is, until it is dismissed or started again', async () => {
  const page = await bed.open();
  await uploadText(page, 'dying.json', smallShow(2, 30));
  const end = await startRobots(bed.server, 2);
  await page.getByText('2 robots', { exact: true }).waitFor();
  await button(page, 'Play').click();
  await phaseIs(page, 'playing');
  await end();
  const failure = page.getByRole('alert').filter({ hasText: 'Show stopped in frame' });
  await failure.getByText(/^Show stopped in frame [12]: all 2 robots lost contact\.$/).waitFor();
  expect(await page.getByTestId('phase').textContent()).toBe('Show stopped');
  // Every screen says so, and after loading again too.
  await page.reload();
  await failure.waitFor();
  const second = await bed.open();
  await second.getByRole('alert').filter({ hasText: 'Show stopped in frame' }).waitFor();
  await failure.getByRole('button', { name: 'Got it' }).click();
  await failure.waitFor({ state: 'detached' });
  await second.getByTestId('phase').getByText('Ready').waitFor();
});
