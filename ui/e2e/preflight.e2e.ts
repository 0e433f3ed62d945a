import { expect, test } from 'vitest';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { introduceRealRobot } from './realRobot';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '4');

test('a preflight is explained, shows its progress, passes healthy robots and names a silent one', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'preflight.json', smallShow(4, 1));
  await phaseIs(page, 'ready');
  await button(page, 'Preflight…').click();
  const dialog = page.getByRole('dialog', { name: 'Preflight' });
  await dialog.getByText('Each robot drives 50 mm out').waitFor();
  await dialog.getByRole('button', { name: 'Drive robots' }).click();
  await dialog.getByTestId('preflight-progress').getByText('Driving out').waitFor();
  await dialog.getByTestId('preflight-progress').getByText('Driving back').waitFor();
  const verdict = dialog.getByTestId('preflight-verdict');
  await verdict.getByText('All 4 robots passed.').waitFor();

  // A real robot reports once and then does not answer: the others are tested, and it is named with a remedy.
  const leave = await introduceRealRobot(bed.server, 'mute-robot', -1, -1);
  await dialog.getByRole('button', { name: 'Again: Drive real robots' }).click();
  await verdict.getByText('4 of 5 robots passed.').waitFor({ timeout: 120_000 });
  const named = dialog.getByRole('list', { name: 'Robots with faults' }).getByRole('listitem');
  // The list comes with the next message about the robots, shortly after the verdict.
  await named.first().waitFor();
  expect(await named.count()).toBe(1);
  expect(await named.textContent()).toMatch(/mute-rob.*It does not report\. Charge it/s);
  expect(await named.getByRole('button', { name: 'Identify' }).isDisabled()).toBe(true);
  leave();
});

test('Abort ends a preflight, and robots that were not tested are named', async () => {
  const page = await bed.open('live');
  await phaseIs(page, 'ready');
  await button(page, 'Preflight…').click();
  const dialog = page.getByRole('dialog', { name: 'Preflight' });
  await dialog.getByRole('button', { name: /Drive (real )?robots/ }).click();
  await dialog.getByTestId('preflight-progress').getByText('Driving out').waitFor();
  await dialog.getByRole('button', { name: 'Abort' }).click();
  await dialog.getByText(/The preflight ended early: 0 of \d robots passed\./).waitFor();
  await dialog
    .getByText('It was not tested, because the preflight ended before.')
    .first()
    .waitFor();
});
