import { test } from 'vitest';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

/** What the page of the test has instead of a MIDI device. */
interface FakeMidi {
  /** Sends quarter frames of 25 frames a second from a time on, seconds. */
  runCode(from_s: number): void;
  stopCode(): void;
  hit(note: number): void;
}

/** Puts a MIDI device into the page; its code runs by the clock of the page. */
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
        // Pages wake up late: what is due is sent at once.
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

test('time code plays a show, a jump of the code pauses it, and a pad gives GO', async () => {
  const page = await bed.open('live');
  await page.addInitScript(fakeMidi);
  await page.reload();
  const show = JSON.parse(smallShow(6, 30)) as { frames: object[] };
  const frames = show.frames.map((frame, i) => ({ ...frame, id: `f${i}` }));
  const cues = [{ name: 'Curtain', frame: 'f0' }];
  await uploadText(page, 'coded.json', JSON.stringify({ ...show, lightbots: 2, frames, cues }));
  await page.getByRole('tab', { name: 'Light' }).click();
  await button(page, 'Use MIDI pads').click();
  const begins = page.getByRole('textbox', { name: 'It begins at' });
  await begins.fill('01:00');
  await page.getByText('Type a time such as 01:00:00').waitFor();
  await begins.fill('00:10:00');
  await begins.press('Enter');
  await page.getByRole('checkbox', { name: 'MIDI time code plays the show' }).click();
  await page.getByText('No time code comes.').waitFor();

  const midi = (act: keyof FakeMidi, value: number) =>
    page.evaluate(
      ([name, number]) => {
        const { fakeMidi: fake } = window as unknown as { fakeMidi: FakeMidi };
        (fake[name] as (n: number) => void)(number);
      },
      [act, value] as const,
    );
  await midi('runCode', 10 * 60 - 2);
  await page.getByText(/^Time code 00:09:5/).waitFor();
  await phaseIs(page, 'playing');
  await page
    .getByText(/Waiting for GO, frame 1 of 2|Showing frame 1 of 2/)
    .first()
    .waitFor();

  await midi('runCode', 11 * 60);
  await page.getByText(/Time code is [\d.]+ s ahead of the show, which is paused/).waitFor();
  await phaseIs(page, 'paused');
  await button(page, 'Resume').click();
  await phaseIs(page, 'playing');

  // A pad learns GO.
  await page.getByRole('combobox', { name: 'Give a pad to' }).click();
  await page.getByRole('option', { name: 'GO', exact: true }).click();
  await midi('hit', 80);
  await page.getByText('MIDI devices: Desk.').waitFor();
  await midi('hit', 80);
  await page.getByText('Playing frame 2 of 2').waitFor();
  // The show counts from where robots drive: code that stops before means nothing.
  await page.waitForTimeout(2_500);
  await midi('stopCode', 0);
  await page.getByText('Time code has stopped: the show is paused.').waitFor();
  await phaseIs(page, 'paused');
});
