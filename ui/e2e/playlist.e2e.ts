import { expect, test } from 'vitest';
import type { PlaylistState } from '../src/api/types.gen';
import { findings } from './axe';
import { button, countIs, phaseIs, smallShow, uploadText } from './journeys';
import { eventually } from './harness';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('a playlist is made on the screen, and its first show starts by itself', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'matinee.json', smallShow(6, 20));
  await phaseIs(page, 'ready');
  await button(page, 'New').click();
  const panel = page.getByRole('region', { name: 'Playlist' });
  const rows = panel.getByRole('list', { name: 'Playlist' }).getByRole('listitem');
  const dialog = page.getByRole('dialog');

  // The first entry has the present time: it is due as soon as the playlist is switched on.
  await panel.getByRole('button', { name: 'Add to the playlist' }).click();
  await dialog.getByRole('combobox', { name: 'Show' }).selectOption('matinee');
  await dialog.getByRole('combobox', { name: 'Speed of drives' }).selectOption('50');
  const saturday = dialog.getByRole('button', { name: 'Saturday' });
  await saturday.click();
  await dialog.getByText('On the marked days').waitFor();
  expect(await findings(page)).toEqual([]);
  await saturday.press('Space');
  await dialog.getByText('Every day').waitFor();
  await dialog.getByRole('button', { name: 'Add' }).click();
  await dialog.waitFor({ state: 'hidden' });
  await countIs(rows, 1);
  expect(await findings(page)).toEqual([]);

  // The second entry is made by keyboard alone; it follows after a pause.
  await panel.getByRole('button', { name: 'Add to the playlist' }).focus();
  await page.keyboard.press('Enter');
  const heart = dialog.getByRole('option', { name: 'heart' });
  await heart.waitFor({ state: 'attached' });
  await dialog.getByRole('combobox', { name: 'Show' }).focus();
  await page.keyboard.type('heart');
  const after = dialog.getByRole('radio', { name: 'After the show before' });
  await after.focus();
  await page.keyboard.press('Space');
  const pause = dialog.getByRole('textbox', { name: 'Pause after it, minutes' });
  await pause.focus();
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Space');
  await dialog.getByRole('button', { name: 'Add' }).press('Enter');
  await dialog.waitFor({ state: 'hidden' });
  await countIs(rows, 2);
  await rows.nth(1).getByText('Home, then 16 min after the show before · 100 %').waitFor();

  // As the first entry it would have no show before it: the server refuses the move, and the list stays.
  await panel.getByRole('button', { name: 'Change heart, entry 2' }).focus();
  await page.keyboard.press('Alt+ArrowUp');
  await page
    .getByRole('alert')
    .getByText(/entry 1: the first entry/)
    .waitFor();
  await rows.nth(0).getByText('matinee').waitFor();

  await panel.getByText('Off: no show starts by itself.').waitFor();
  await panel.getByRole('switch', { name: 'Play by schedule' }).press('Space');
  await dialog.getByText(/^6 simulated robots start by themselves at once: matinee\./).waitFor();
  await dialog.getByRole('button', { name: 'Play by schedule' }).press('Enter');
  await rows
    .nth(0)
    .getByText(/^Playing since/)
    .waitFor();
  await panel.getByText('matinee plays now.').waitFor();

  // The live page shows that it plays. A stop holds the remaining entries until Go on is pressed.
  await page.goto(`${bed.server.url}/#/live`);
  await phaseIs(page, 'playing');
  await page.getByTestId('playlist-note').getByText('By schedule. matinee plays now.').waitFor();
  await page.keyboard.press('Shift+Escape');
  const note = page.getByTestId('playlist-note');
  await note.getByText(/Stop all was pressed: no show starts by schedule/).waitFor();
  await note.getByRole('button', { name: 'Go on' }).click();
  await note.getByText(/By schedule\. Next: heart at/).waitFor();
  const state = await page.evaluate(
    async () => (await (await fetch('/api/playlist')).json()) as PlaylistState,
  );
  expect(state.today.map(({ result }) => result)).toEqual(['failed', 'waiting']);

  // After the entry is removed and the playlist is switched off, no show starts by itself.
  await note.getByRole('button', { name: 'Playlist' }).click();
  await panel.getByRole('button', { name: 'Change heart, entry 2' }).focus();
  await page.keyboard.press('Delete');
  await countIs(rows, 1);
  await panel.getByRole('switch', { name: 'Play by schedule' }).press('Space');
  await eventually(
    () => panel.getByText('Off: no show starts by itself.').count(),
    (count) => count === 1,
    'the playlist is off',
  );
});
