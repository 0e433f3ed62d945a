import { expect, test } from 'vitest';
import {
  button,
  countIs,
  hasKeys,
  phaseIs,
  pixelsAre,
  saved,
  smallShow,
  stored,
  uploadText,
} from './journeys';
import { eventually } from './harness';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

test('a frame waits for GO: set in the editor, given on the live page by key and by button', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'curtain.json', smallShow(6));
  await pixelsAre(page, 6);
  await page.getByRole('tab', { name: 'Frame' }).click();
  await page.getByRole('checkbox', { name: 'Wait for GO after this' }).click();
  const name = page.getByRole('textbox', { name: 'Cue' });
  await name.fill('Curtain');
  await name.press('Enter');
  const marks = page.getByRole('list', { name: 'Frames' }).getByTitle('Waits for GO');
  await countIs(marks, 1);
  await saved(page);
  const { cues } = (await stored(page, 'curtain')) as unknown as { cues: unknown };
  expect(cues).toEqual([{ name: 'Curtain', frame: 'f1' }]);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await countIs(marks, 0);
  await page.keyboard.press('Control+Shift+z');
  await page.keyboard.press('Control+Shift+z');
  await countIs(marks, 1);

  for (const give of [
    () => page.keyboard.press('Enter'),
    () => button(page, 'GO (Enter)').click(),
  ]) {
    if (page.url().includes('#/edit')) await button(page, 'Run on robots').click();
    else await button(page, 'Play').click();
    const note = page.getByTestId('go-note');
    await note.getByText('Curtain').waitFor();
    await note.getByText('Next: frame 2, Two').waitFor();
    await page.getByText('Waiting for GO, frame 1 of 2').waitFor();
    await phaseIs(page, 'playing');
    await give();
    await note.waitFor({ state: 'hidden' });
    await page.getByText('Playing frame 2 of 2').waitFor();
    await phaseIs(page, 'ready');
  }
});

/** A show of three frames of six pixels with air times of 0.3 s, 0.3 s and 60 s; the first frame waits for GO. */
function longShow(): string {
  const show = JSON.parse(smallShow(6, 0.3)) as { frames: Record<string, unknown>[] };
  const [one, two] = show.frames;
  const third = { ...one, name: 'Three', air_time_s: 60 };
  const frames = [{ ...one, id: 'first' }, two, third];
  const cues = [{ name: 'Curtain', frame: 'first' }];
  return JSON.stringify({ ...show, lightbots: 2, frames, cues });
}

test('the list of cues says what is next, goes to a frame after one question, and skips', async () => {
  const page = await bed.open('live');
  await uploadText(page, 'list.json', longShow());
  await page.getByRole('tab', { name: 'Cues' }).click();
  const list = page.getByRole('list', { name: 'Cues' });
  await countIs(list.getByRole('listitem'), 3);
  await list.getByText('0.3 s, GO: Curtain').waitFor();
  await countIs(list.getByText('goes on by itself'), 2);
  const head = page.getByTestId('cue-head');

  // Without a show, Go to plays from that frame.
  await button(page, 'Go to frame 1').click();
  const dialog = page.getByRole('dialog');
  await dialog.getByText('Play from frame 1, One?').waitFor();
  await hasKeys(page, 'dialog');
  await page.keyboard.press('Enter');
  await page.getByText('Waiting for GO, frame 1 of 3').waitFor();
  await head.getByText('1 One').waitFor();
  await head.getByText('2 Two').waitFor();

  // Skip moves no robot; GO then leads past the skipped frame.
  await page.keyboard.press('n');
  await head.getByText('3 Three').waitFor();
  await page.getByTestId('go-note').getByText('Next: frame 3, Three').waitFor();
  await phaseIs(page, 'playing');
  await button(page, 'GO (Enter)').click();
  await page.getByText('Playing frame 3 of 3').waitFor();
  await head.getByText('The show ends').waitFor();

  // Robots that drive are not sent elsewhere; robots that stand are, by mouse.
  const goToTwo = button(page, 'Go to frame 2');
  await eventually(
    () => goToTwo.isEnabled(),
    (isEnabled) => isEnabled,
    'robots stand in the last frame',
  );
  await goToTwo.click();
  await dialog.getByText('Go to frame 2, Two?').waitFor();
  await button(page, 'Go there').click();
  await dialog.waitFor({ state: 'hidden' });
  await page.getByText('Playing frame 2 of 3').waitFor();
  await head.getByText('3 Three').waitFor();

  // By keyboard alone, from a pause on the way.
  await page.keyboard.press('Space');
  await phaseIs(page, 'paused');
  await page.keyboard.press('Home');
  await page.keyboard.press('j');
  await dialog.getByText('Go to frame 1, One?').waitFor();
  await hasKeys(page, 'dialog');
  await page.keyboard.press('Enter');
  await page.getByText('Waiting for GO, frame 1 of 3').waitFor();
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
});

test('frames repeat until GO: chosen in the editor, left at the end of a round', async () => {
  const page = await bed.open('edit');
  const show = JSON.parse(longShow()) as { cues: unknown; frames: Record<string, unknown>[] };
  const frames = show.frames.map((frame) => ({ ...frame, air_time_s: 0.3 }));
  await uploadText(page, 'encore.json', JSON.stringify({ ...show, cues: undefined, frames }));
  await pixelsAre(page, 6);
  const strip = page.getByRole('list', { name: 'Frames' });
  await strip.getByRole('button', { name: /Two/ }).click();
  await page.getByRole('tab', { name: 'Frame' }).click();
  await page.getByRole('checkbox', { name: 'Wait for GO after this' }).click();

  // By mouse, then taken back and chosen again by keyboard.
  const until = page.getByRole('combobox', { name: 'Until GO' });
  await until.click();
  await countIs(page.getByRole('option', { name: /Wait here|Repeat from/ }), 3);
  await page.getByRole('option', { name: 'Repeat from 1 One' }).click();
  const marks = strip.getByTitle('Repeats until GO');
  await countIs(marks, 1);
  await page.keyboard.press('Escape');
  await until.blur();
  await page.keyboard.press('Control+z');
  await countIs(marks, 0);
  await until.focus();
  await page.keyboard.press('ArrowDown');
  // The list opens a little later than a key can be pressed again.
  const first = page.getByRole('option', { name: 'Repeat from 1 One' });
  await first.waitFor();
  await eventually(
    async () => {
      const isAt = (await first.getAttribute('data-combobox-selected')) !== null;
      if (!isAt) await page.keyboard.press('ArrowDown');
      return isAt;
    },
    (isAt) => isAt,
    'the first choice is marked',
  );
  await page.keyboard.press('Enter');
  await countIs(marks, 1);
  await saved(page);
  const { cues } = (await stored(page, 'encore')) as unknown as { cues: unknown };
  expect(cues).toEqual([{ frame: 'f1', loop_from: 'first' }]);

  await button(page, 'Run on robots').click();
  const note = page.getByTestId('go-note');
  await note.getByText('Frames 1 to 2 repeat until GO (round 1)').waitFor();
  await note.getByText('Then: frame 3, Three').waitFor();
  await page.getByRole('tab', { name: 'Cues' }).click();
  await page.getByText('repeats from frame 1 until GO').waitFor();
  await note.getByText('Frames 1 to 2 repeat until GO (round 3)').waitFor();
  await page.keyboard.press('PageDown');
  await note.getByText(/^GO was given: on after frame 2/).waitFor();
  await countIs(note.getByRole('button'), 0);
  await page.getByText('Playing frame 3 of 3').waitFor();
  await note.waitFor({ state: 'hidden' });
  await phaseIs(page, 'ready');
});
