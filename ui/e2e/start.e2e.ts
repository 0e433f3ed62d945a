import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { TEMPLATES } from '../src/make/templates';
import { eventually } from './harness';
import { button, phaseIs, pixels, pixelsAre, tabTo } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '30');

const card = (page: Page, title: string) =>
  page.getByRole('button', { name: new RegExp(`^${title}`) });

/** Waits until the open show is planned, and answers the plan. */
const planned = (page: Page) =>
  eventually(
    () =>
      page.evaluate(async () => (await fetch('/api/plan')).json()) as Promise<{
        ok: boolean;
        planning: boolean;
      }>,
    (plan) => !plan.planning,
    'the show is planned',
  );

test('each template becomes a show for the robots that are here, which can be played', async () => {
  const page = await bed.open('live');
  for (const { title, frames } of TEMPLATES) {
    await button(page, 'New').click();
    await card(page, title)
      .getByText(/shown for/)
      .waitFor();
    await card(page, title).click();
    // An example may have that name already; then the show's name ends with 2.
    await page
      .getByTestId('open-library')
      .getByText(new RegExp(`^${title}( 2)?$`))
      .waitFor();
    await pixelsAre(page, 30);
    expect(await page.getByRole('list', { name: 'Frames' }).getByRole('listitem').count()).toBe(
      frames(30).length,
    );
    expect(await planned(page), title).toMatchObject({ ok: true });
  }
  await button(page, 'Run on robots').click();
  await phaseIs(page, 'playing');
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
});

test("by keyboard: a word of one's own, with a verdict, becomes a show", async () => {
  const page = await bed.open('live');
  await tabTo(page, 'button', 'New');
  await page.keyboard.press('Enter');
  const field = page.getByRole('textbox', { name: 'Words to show' });
  await field.waitFor();
  await tabTo(page, 'textbox', 'Words to show');
  await field.fill('');
  await page.keyboard.type('HI');
  await page.getByTestId('word-verdict').getByText('Readable').waitFor();
  await page.keyboard.press('Enter');
  await page.getByTestId('open-library').getByText('HI', { exact: true }).waitFor();
  await pixelsAre(page, 30);
  await page.getByText('Made from the words “HI”').waitFor();
  expect(await pixels(page)).toHaveLength(30);
});

test('a file begins a show of its own', async () => {
  const page = await bed.open('live');
  await button(page, 'New').click();
  const svg =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="9" height="9"/></svg>';
  await page.locator('input[type=file][aria-label="Files to show"]').setInputFiles({
    name: 'logo.svg',
    mimeType: 'image/svg+xml',
    buffer: Buffer.from(svg),
  });
  await button(page, 'Use').click();
  await page.getByText('Made from the file logo.svg').waitFor();
});
