import { expect, test } from 'vitest';
import { eventually } from './harness';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { introduceRealRobot } from './realRobot';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '3');

test('the screen says whether robots are real, and real ones are driven only after a question', async () => {
  const page = await bed.open();
  await uploadText(page, 'kinds.json', smallShow(3, 1));
  await page.getByText('3 robots', { exact: true }).waitFor();
  const kind = page.getByTestId('kind');
  await kind.getByText('Simulated robots').waitFor();
  await page
    .getByRole('button', { name: /^Details of robot/ })
    .first()
    .click();
  await page.getByRole('dialog').getByText('simulated', { exact: true }).waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  await button(page, 'Drive robots to this frame (P)').click();
  await phaseIs(page, 'preview');
  await phaseIs(page, 'ready');

  const leave = await introduceRealRobot(bed.server, 'r7', 1.2, -1.2);
  await kind.getByText('Real robots').waitFor();
  await page.keyboard.press('p');
  const question = page.getByRole('dialog', {
    name: 'Drive 4 robots to frame 1, 1 of them real?',
  });
  await question.getByRole('button', { name: 'Not now' }).click();
  await question.waitFor({ state: 'hidden' });
  expect(await page.getByTestId('phase').getAttribute('data-phase')).toBe('ready');
  await page.keyboard.press('p');
  await question.getByRole('button', { name: 'Drive robots' }).click();
  await phaseIs(page, 'preview');
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
  leave();
});

const SIZES = [
  [1440, 900],
  [1024, 768],
  [720, 450],
  [390, 844],
  [320, 568],
] as const;

test('Stop all is there whole, on every page and above every dialog, at every size', async () => {
  for (const view of ['live', 'edit'] as const)
    for (const [width, height] of SIZES) {
      const page = await bed.open(view, { viewport: { width, height } });
      const stop = page.getByTestId('stop-all');
      const isReached = () =>
        stop.evaluate((button) => {
          const box = button.getBoundingClientRect();
          const inside =
            box.left >= 0 && box.top >= 0 && box.right <= innerWidth && box.bottom <= innerHeight;
          const corners = [0.1, 0.5, 0.9].map((share) =>
            document.elementFromPoint(box.left + box.width * share, box.top + box.height / 2),
          );
          const text = button.querySelector('.mantine-Button-label');
          const whole = text !== null && text.scrollWidth <= text.clientWidth + 1;
          const onTop = corners.every((element) => element !== null && button.contains(element));
          return inside && whole && onTop && box.height >= 36;
        });
      const what = `${view} ${width} × ${height}`;
      await eventually(isReached, Boolean, `Stop all is whole on ${what}`);
      const overflow = () =>
        page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      expect(await overflow(), what).toBeLessThanOrEqual(0);
      await page.keyboard.press('Control+o');
      await page.getByRole('dialog').waitFor();
      await eventually(isReached, Boolean, `Stop all is above the library on ${what}`);
      await page.close();
    }
});
