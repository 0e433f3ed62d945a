import type { Page } from 'playwright-core';
import { test } from 'vitest';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

/** What the test's page has in place of a MIDI device. */
interface FakeMidi {
  /** Sends quarter frames at 25 frames a second, from the time `from_s` on, seconds. */
  runCode(from_s: number): void;
  stopCode(): void;
  hit(note: number): void;
}

/** Runs in the page: puts a MIDI device into it. Its time code runs by the page's clock. */
function fakeMidi() {
  const input = {
    name: 'Desk',
    onmidimessage: null as ((event: { data: Uint8Array }) => void) | null,
  };
  const send = (...data: number[]) => input.onmidimessage?.({ data: new Uint8Array(data) });
  let timer: ReturnType<typeof setInterval> | undefined;
  const midi: FakeMidi = {
    runCode(from_s) {
      clearInterval(timer);
      const began_ms = performance.now();
      let sent = 0;
      timer = setInterval(() => {
        // Timers of pages are late: all pieces that are due are sent at once.
        for (; began_ms + sent * 10 <= performance.now(); sent++) {
          const frame = Math.round(from_s * 25) + 2 * Math.floor(sent / 8);
          const [frames, all] = [frame % 25, Math.floor(frame / 25)];
          const fields = [frames, all % 60, Math.floor(all / 60) % 60, Math.floor(all / 3600) + 32];
          const piece = sent % 8;
          const field = fields[piece >> 1] ?? 0;
          send(0xf1, (piece << 4) | (piece % 2 === 0 ? field & 15 : field >> 4));
        }
      }, 20);
    },
    stopCode: () => clearInterval(timer),
    hit: (note) => void send(0x90, note, 99),
  };
  const access = { inputs: new Map([['1', input]]), onstatechange: null };
  Object.assign(navigator, { requestMIDIAccess: () => Promise.resolve(access) });
  Object.assign(window, { fakeMidi: midi });
}

/** Calls a function of the page's device. */
const say = (page: Page, act: keyof FakeMidi, value: number) =>
  page.evaluate(
    ([name, number]) => {
      const { fakeMidi: midi } = window as unknown as { fakeMidi: FakeMidi };
      (midi[name] as (n: number) => void)(number);
    },
    [act, value] as const,
  );

/** Uploads a show on the live page, and lets the page use the device. */
async function withDevice(name: string, show: string) {
  const page = await bed.open('live');
  await page.addInitScript(fakeMidi);
  await page.reload();
  await uploadText(page, name, show);
  await page.getByRole('tab', { name: 'Light' }).click();
  await button(page, 'Use MIDI pads').click();
  return page;
}

test('time code plays a show, and pauses it where it jumps or stops', async () => {
  const page = await withDevice('coded.json', smallShow(6, 60));
  const begins = page.getByRole('textbox', { name: 'It begins at' });
  await begins.fill('01:00');
  await page.getByText('Type a time such as 01:00:00').waitFor();
  await begins.fill('00:10:00');
  await begins.press('Enter');
  await page.getByRole('checkbox', { name: 'MIDI time code plays the show' }).click();
  await page.getByText('No time code comes.').waitFor();

  await say(page, 'runCode', 10 * 60 - 2);
  await page.getByText(/^Time code 00:09:5/).waitFor();
  await phaseIs(page, 'playing');
  // Time code and show are compared from the first frame on; the drive to it takes some seconds.
  await page.getByText('Playing frame 1 of 2').waitFor();
  await page.waitForTimeout(8_000);
  await say(page, 'runCode', 11 * 60);
  await page.getByText(/Time code is [\d.]+ s ahead of the show, which is paused/).waitFor();
  await phaseIs(page, 'paused');

  await button(page, 'Resume').click();
  await phaseIs(page, 'playing');
  await page.waitForTimeout(1_000);
  await say(page, 'stopCode', 0);
  await page.getByText('Time code has stopped: the show is paused.').waitFor();
  await phaseIs(page, 'paused');
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
});

test('a pad gives GO once it has learned that', async () => {
  const show = JSON.parse(smallShow(6)) as { frames: object[] };
  const frames = show.frames.map((frame, i) => ({ ...frame, id: `f${i}` }));
  const cues = [{ name: 'Curtain', frame: 'f0' }];
  const text = JSON.stringify({ ...show, lightbots: 2, frames, cues });
  const page = await withDevice('pad.json', text);
  await button(page, 'Play').click();
  await page.getByText('Waiting for GO, frame 1 of 2').waitFor();
  await say(page, 'hit', 48);
  await page.getByRole('combobox', { name: 'Give a pad to' }).click();
  await page.getByRole('option', { name: 'GO', exact: true }).click();
  await say(page, 'hit', 80);
  await page.getByText('MIDI devices: Desk.').waitFor();
  await page.getByText('Waiting for GO, frame 1 of 2').waitFor();
  await say(page, 'hit', 80);
  await page.getByText('Playing frame 2 of 2').waitFor();
  await phaseIs(page, 'ready');
});
