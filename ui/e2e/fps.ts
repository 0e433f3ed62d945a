import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { test } from 'vitest';
import { crowdShow, LAYERS, longShow, sideOf } from './crowds';
import { measure, measureShown, noteDraws, type Measured } from './drawnFrames';
import { eventually, openPage, startServer } from './harness';
import { scaleOf } from './journeys';
import { createBrowserBed } from './testBed';

/** Frames a second that are promised, by number of robots; other numbers of robots are only measured. */
const GOALS: Record<number, number> = { 30: 58, 100: 58, 1000: 30 };

const bed = createBrowserBed('fps');

/**
 * Measures for 2 s the size and rate of the messages that a screen gets, and the speed of the show clock. The clock
 * goes slower on a machine that is too slow for its simulated robots.
 */
const snapshots = (page: Page) =>
  page.evaluate(async () => {
    const socket = new WebSocket(`ws://${location.host}/ws`);
    socket.binaryType = 'arraybuffer';
    let [bytes, count, pace] = [0, 0, 1];
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === 'string' && !data.startsWith('{"type":"state"')) return;
      bytes += typeof data === 'string' ? data.length : data.byteLength;
      if (typeof data !== 'string') return;
      count++;
      pace = (JSON.parse(data) as { pace: number }).pace;
      socket.send('{"type":"took"}');
    };
    await new Promise((resolve) => (socket.onopen = resolve));
    await new Promise((resolve) => setTimeout(resolve, 2000));
    socket.close();
    return {
      snapshot_kB: bytes / Math.max(1, count) / 1000,
      snapshots_a_second: count / 2,
      'show_time_%_of_real_time': Math.round(pace * 100),
    };
  });

const row = (scene: string, robots: number, measured: Measured, more = {}) =>
  process.stdout.write(
    `\n${JSON.stringify({
      scene,
      robots,
      frames_a_second: measured.fps,
      goal: GOALS[robots] ?? null,
      '95_%_of_gaps_below_ms': measured.late_ms,
      main_thread_ms_a_frame: measured.busy_ms,
      snapshot_kB: null,
      snapshots_a_second: null,
      'show_time_%_of_real_time': null,
      ...more,
    })}\n`,
  );

/**
 * Measures while the pressed mouse moves along `path`, CSS pixels. The parameter of `path` grows by 0.05 every 8 ms.
 * `modifiers`: 1 holds Alt, 0 holds no key. `by` measures.
 */
async function measureDrag(
  page: Page,
  path: (turn: number) => { x: number; y: number },
  { modifiers = 0, by = measure } = {},
) {
  const from = path(0);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // Events are sent directly: Playwright's mouse runs scripts of its own in the page at every step of a drag.
  const client = await page.context().newCDPSession(page);
  let [turn, moving] = [0, true];
  const hand = (async () => {
    while (moving) {
      turn += 0.05;
      const held = { button: 'left', buttons: 1, modifiers } as const;
      const moved = { type: 'mouseMoved', ...path(turn), ...held } as const;
      // A slow page may be closed before it takes the last events.
      client.send('Input.dispatchMouseEvent', moved).catch(() => undefined);
      await new Promise((resolve) => setTimeout(resolve, 8));
    }
  })();
  const measured = await by(page);
  moving = false;
  await hand;
  await client.detach();
  await page.mouse.up();
  return measured;
}

async function dragAll(page: Page, robots: number, scene: string) {
  await page.keyboard.press('Control+a');
  const box = await page.getByTestId('stage').boundingBox();
  const place = await page.evaluate(() => ({
    ...document.querySelector<HTMLElement>('[data-testid=pixels] [role=option]')?.dataset,
  }));
  if (!box || !place.x || !place.y) throw new Error('There is nothing to drag.');
  const scale = scaleOf(box, sideOf(robots));
  const from = {
    x: box.x + box.width / 2 + Number(place.x) * scale,
    y: box.y + (box.height + 20) / 2 - Number(place.y) * scale,
  };
  const measured = await measureDrag(page, (turn) => ({
    x: from.x + 60 * Math.sin(turn),
    y: from.y + 40 * (1 - Math.cos(turn)),
  }));
  row(scene, robots, measured);
}

/** Measures while the slider of the preview is dragged along the show and back, again and again. */
async function scrub(page: Page, robots: number, scene: string) {
  const thumb = page.getByRole('slider', { name: 'Moment of the show' });
  const box = await thumb.locator('xpath=../..').boundingBox();
  if (!box) throw new Error('There is no slider.');
  const measured = await measureDrag(page, (turn) => ({
    x: box.x + box.width * (0.5 - 0.45 * Math.cos(turn)),
    y: box.y + box.height / 2,
  }));
  row(scene, robots, measured);
}

async function watch(page: Page, robots: number, scene: string) {
  await page.getByRole('button', { name: 'Loop (L)' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByText(/Playing frame 2 of/).waitFor();
  const measured = await measure(page);
  row(scene, robots, measured, await snapshots(page));
}

/** Measures the audience view, from above and in perspective. */
async function watchAsAudience(page: Page, robots: number) {
  const view = page.locator('[data-viewpoint]');
  await view.waitFor();
  row('audience, from above', robots, await measure(page));
  await page.keyboard.press('p');
  row('audience, in perspective', robots, await measure(page));
}

/** Starts a server with a crowd of `robots` robots, opens the editor and runs `scenes`; `go` changes the view. */
async function withCrowd(
  robots: number,
  layers: readonly object[],
  scenes: (page: Page, go: (view: 'live' | 'audience') => Promise<unknown>) => Promise<void>,
) {
  const file = join(bed.folder, `crowd ${robots} ${layers.length}.lightbots.json`);
  writeFileSync(file, crowdShow(robots, layers));
  const server = await startServer(file, '--robots', String(robots));
  try {
    const page = await openPage(bed.browser, server, 'edit', {}, noteDraws);
    await page.getByTestId('stage').waitFor();
    await page.getByText(`${robots} robots`, { exact: true }).waitFor();
    await scenes(page, (view) => page.goto(`${server.url}/#/${view}`));
    await page.close();
  } finally {
    await server.remove();
  }
}

for (const robots of [30, 100, 1000, 10_000])
  test(`frames a second with ${robots} robots`, () =>
    withCrowd(robots, [], async (page, go) => {
      // If one scene fails, the other is measured nevertheless.
      const edited =
        robots <= 1000 ? await Promise.allSettled([dragAll(page, robots, 'drag all')]) : [];
      await go('live');
      await watch(page, robots, 'watch live');
      await go('audience');
      await watchAsAudience(page, robots);
      for (const scene of edited) if (scene.status === 'rejected') throw scene.reason;
    }));

for (const robots of [30, 100, 1000])
  test(`frames a second with light on ${robots} robots`, () =>
    withCrowd(robots, LAYERS, async (page, go) => {
      // The stage shows light of the frame on it while the panel of layers is open.
      await page.getByRole('tab', { name: 'Light' }).click();
      await page.getByRole('list', { name: 'Layers, the uppermost first' }).waitFor();
      const edited = await Promise.allSettled([dragAll(page, robots, 'drag all, light')]);
      edited.push(...(await Promise.allSettled([scrub(page, robots, 'scrub, light')])));
      await go('live');
      await watch(page, robots, 'watch live, light');
      await go('audience');
      await watchAsAudience(page, robots);
      for (const scene of edited) if (scene.status === 'rejected') throw scene.reason;
    }));

const [FRAMES, TIMELINE_LAYERS, TIMELINE_ROBOTS] = [200, 50, 30];

/** Measures while the wheel scrolls the timeline at `at` to and fro, one event every 8 ms. */
async function measureScroll(page: Page, at: { x: number; y: number }) {
  const client = await page.context().newCDPSession(page);
  let [rolls, rolling] = [0, true];
  const wheel = (async () => {
    while (rolling) {
      const deltaX = Math.floor(rolls++ / 200) % 2 === 0 ? 20 : -20;
      const rolled = { type: 'mouseWheel', ...at, deltaX, deltaY: 0 } as const;
      client.send('Input.dispatchMouseEvent', rolled).catch(() => undefined);
      await new Promise((resolve) => setTimeout(resolve, 8));
    }
  })();
  const measured = await measureShown(page);
  rolling = false;
  await wheel;
  await client.detach();
  return measured;
}

test(`frames a second of a timeline of ${FRAMES} frames and ${TIMELINE_LAYERS} layers`, async () => {
  const file = join(bed.folder, 'long.lightbots.json');
  writeFileSync(file, longShow(TIMELINE_ROBOTS, FRAMES, TIMELINE_LAYERS));
  const server = await startServer(file, '--robots', String(TIMELINE_ROBOTS));
  try {
    const page = await openPage(bed.browser, server, 'edit');
    await page.getByTestId('stage').waitFor();
    await page.keyboard.press('l');
    await page.getByRole('option', { name: /^Frame 3 Frame 3: drive [\d.]+ s/ }).waitFor();
    // Farther away: more blocks are drawn, and their edges can still be dragged.
    for (let i = 0; i < 2; i++)
      await page.getByRole('button', { name: 'Zoom the timeline out (−)' }).click();
    await page.locator('[data-frame="2"]').click();
    const list = await page.getByRole('listbox', { name: 'Frames on the timeline' }).boundingBox();
    if (!list) throw new Error('There are no frames.');
    row(
      'scroll timeline',
      TIMELINE_ROBOTS,
      await measureScroll(page, { x: 600, y: list.y + list.height / 2 }),
    );
    const edge = await eventually(
      async () => {
        // The wheel rolls on for a moment.
        await page.keyboard.press('Home');
        return page.locator('[data-frame="2"] [data-edge=air]').boundingBox();
      },
      (box) => box !== null && box.x > list.x,
      'the first frames are in sight',
    );
    if (!edge) throw new Error('There is no edge to drag.');
    const from = { x: edge.x + edge.width / 2, y: edge.y + edge.height / 2 };
    // With Alt, which leaves out snapping: a drag that snaps moves in steps, and not in every frame.
    const path = (turn: number) => ({ x: from.x + 60 * (1 - Math.cos(turn)), y: from.y });
    const dragged = await measureDrag(page, path, { modifiers: 1, by: measureShown });
    row('drag in timeline', TIMELINE_ROBOTS, dragged);
    await page.close();
  } finally {
    await server.remove();
  }
});
