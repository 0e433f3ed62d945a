import { expect, test } from 'vitest';
import { eventually } from './harness';
import { button, countIs, phaseIs, robotPlaces, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '4');

test('a show that is stopped says where on every screen, and plays on from there', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'stopped.json', smallShow(4, 20));
  await button(page, 'Play').click();
  await page.getByText('Playing frame 1 of 2').waitFor();
  await page.keyboard.press('Shift+Escape');
  const note = page.getByTestId('stopped-note');
  await note.getByText('Stopped in frame 1. Robots stand where they were.').waitFor();
  await phaseIs(page, 'ready');
  expect(await page.getByTestId('phase').textContent()).toBe('Stopped');
  const second = await bed.open('live');
  await second.getByTestId('stopped-note').waitFor();
  await note.getByRole('button', { name: 'Play on from frame 1' }).click();
  await page.getByText('Playing frame 1 of 2').waitFor();
  await second.getByTestId('stopped-note').waitFor({ state: 'hidden' });
  await button(page, 'Abort (Esc)').click();
  await note.getByRole('button', { name: 'Home' }).click();
  await page.getByText('Driving home').waitFor();
  await phaseIs(page, 'ready');
  await eventually(
    () => robotPlaces(page),
    (places) => places.length === 4 && places.every(([, y]) => Math.abs(y - 1.3) < 0.03),
    'all robots stand in the row at the back edge',
  );
  await button(page, 'Play').click();
  await page.getByText('Playing frame 1 of 2').waitFor();
  await button(page, 'Abort (Esc)').click();
  await note.getByRole('button', { name: 'Got it' }).click();
  await note.waitFor({ state: 'hidden' });
  await second.getByTestId('phase').getByText('Ready').waitFor();
});

test('half the speed is chosen in the checklist, and every screen shows it', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'slow.json', smallShow(4, 1));
  await page.keyboard.press('c');
  const dialog = page.getByRole('dialog', { name: 'Before you start' });
  await dialog.getByText('50 %', { exact: true }).click();
  const second = await bed.open('live');
  await second.getByText('drives at 50 %').waitFor();
  await dialog.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByText('Playing frame 2 of 2').waitFor();
  await phaseIs(page, 'ready');
  await page.keyboard.press('c');
  await dialog.getByText('100 %', { exact: true }).click();
  await second.getByText('drives at 50 %').waitFor({ state: 'hidden' });
});

test('half the speed is offered until these robots have played the show to its end', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'first.json', smallShow(3, 2));
  const dialog = page.getByRole('dialog', { name: 'Before you start' });
  const offer = dialog.getByTestId('first-run');
  const full = dialog.getByRole('radio', { name: '100 %' });
  const atFullSpeed = async () => {
    await page.keyboard.press('c');
    await dialog.getByText('100 %', { exact: true }).click();
    await eventually(
      () => full.isChecked(),
      (checked) => checked,
      'full speed in the checklist',
    );
  };
  const playAtHalfSpeed = async () => {
    await page.keyboard.press('c');
    await offer.getByRole('button', { name: 'Drive at 50 %' }).click();
    await offer.waitFor({ state: 'detached' });
    await dialog.getByRole('button', { name: 'Play', exact: true }).click();
    await page.getByText('Playing frame 1 of 2').waitFor();
  };

  // A run that is stopped does not count as played to its end.
  await playAtHalfSpeed();
  await button(page, 'Abort (Esc)').click();
  await phaseIs(page, 'ready');
  await atFullSpeed();
  await offer.waitFor();
  await dialog.getByRole('button', { name: 'Not now' }).click();
  // The dialog receives keys until it has faded out.
  await countIs(page.locator('[role="dialog"]'), 0);

  await playAtHalfSpeed();
  await page.getByText('Playing frame 2 of 2').waitFor();
  await phaseIs(page, 'ready');
  await atFullSpeed();
  await offer.waitFor({ state: 'detached' });
  await page.reload();
  await phaseIs(page, 'ready');
  await atFullSpeed();
  expect(await offer.count()).toBe(0);
});
