import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, test } from 'vitest';
import { launchBrowser, openPage, startServer } from './harness';
import { scaleOf } from './journeys';

/** How long a scene is measured, milliseconds. */
const MEASURED_MS = 6000;
/** Frames a second that are promised, by number of robots; none for those that are only stated. */
const GOALS: Record<number, number> = { 30: 58, 100: 58, 1000: 30 };
/** Three layers that move; only in some scenes. */
const LAYERS = [
  { kind: 'rainbow', settings: { speed_hz: 0.2 } },
  { kind: 'chase', settings: { palette: ['#000000', '#ffffff'], blend: 'add' } },
  { kind: 'twinkle', settings: { palette: ['#000000', '#ffffff'], blend: 'add' } },
];

let browser: Browser;
const folder = mkdtempSync(join(tmpdir(), 'lightbots-fps-'));
beforeAll(async () => {
  browser = await launchBrowser();
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Side of the square floor for so many robots, metres. */
const sideOf = (count: number) => Math.ceil(Math.sqrt(count)) * 0.12 + 1;

/** Two crowds of `count` coloured pixels, each a turned copy of the other: all robots drive nearly all the time. Robots
 * start in the first, so that a crowd of thousands needs no minutes to get there. */
function crowdShow(count: number, layers: readonly object[]): string {
  const across = Math.ceil(Math.sqrt(count));
  const side_m = sideOf(count);
  const round = (n: number) => Math.round(n * 1e4) / 1e4;
  const frame = (name: string, angle: number) => ({
    name,
    air_time_s: 0.2,
    pixels: Array.from({ length: count }, (_, id) => {
      const [u, v] = [(id % across) - (across - 1) / 2, Math.floor(id / across) - (across - 1) / 2];
      const [x, y] = [u * 0.085, v * 0.085];
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const hue = Math.floor((id * 0x9e3779) % 0xffffff) | 0x404040;
      return {
        id,
        place: [round(c * x - s * y), round(s * x + c * y)],
        color: `#${hue.toString(16).padStart(6, '0')}`,
      };
    }),
  });
  const stage = { width_m: side_m, depth_m: side_m };
  const frames = [frame('One', 0), frame('Two', 0.7)];
  const starts = frames[0]?.pixels.map((pixel) => pixel.place);
  const name = `Crowd of ${count}`;
  return JSON.stringify({ lightbots: 2, name, stage, starts, frames, layers });
}

/** Notes the moment of every frame in which the stage was drawn. */
function noteDraws() {
  const drawn: number[] = [];
  Object.assign(globalThis, { drawn });
  const prototype = CanvasRenderingContext2D.prototype;
  const setTransform = prototype.setTransform as (...a: unknown[]) => void;
  prototype.setTransform = function (this: CanvasRenderingContext2D, ...more: unknown[]) {
    const now = Number(document.timeline.currentTime);
    if (now !== drawn[drawn.length - 1] && this.canvas.closest('section')) drawn.push(now);
    setTransform.apply(this, more);
  } as never;
}

/** Frames a second with the stage drawn, the gap that one frame in twenty exceeds, and main-thread work a frame. */
async function measure(page: Page) {
  const client = await page.context().newCDPSession(page);
  // Its own time on a core: what else the machine does is not its work.
  await client.send('Performance.enable', { timeDomain: 'threadTicks' });
  const busy_s = async () =>
    (await client.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration')
      ?.value ?? 0;
  const before_s = await busy_s();
  const gaps = await page.evaluate(async (lasts_ms) => {
    const { drawn } = globalThis as unknown as { drawn: number[] };
    drawn.length = 0;
    const began = performance.now();
    await new Promise((resolve) => setTimeout(resolve, lasts_ms));
    const span_ms = performance.now() - began;
    return {
      count: drawn.length,
      span_ms,
      all: drawn.slice(1).map((at, i) => at - (drawn[i] ?? at)),
    };
  }, MEASURED_MS);
  const busy_ms = ((await busy_s()) - before_s) * 1000;
  await client.detach();
  const sorted = gaps.all.sort((a, b) => a - b);
  return {
    fps: (gaps.count / gaps.span_ms) * 1000,
    late_ms: sorted[Math.floor(sorted.length * 0.95)] ?? null,
    busy_ms: busy_ms / Math.max(1, gaps.count),
  };
}

/** Size and number of the snapshots that a screen gets, and how fast the show clock goes: a machine that is too slow for
 * its simulated robots slows them down. */
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

const row = (
  scene: string,
  robots: number,
  measured: Awaited<ReturnType<typeof measure>>,
  more = {},
) =>
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

/** Measures while a pressed hand moves along `path`, whose parameter grows by 0.05 each 8 ms. */
async function measureDrag(page: Page, path: (turn: number) => { x: number; y: number }) {
  const from = path(0);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // The hand itself: Playwright's mouse runs scripts of its own in the page at every step of a drag.
  const client = await page.context().newCDPSession(page);
  let [turn, moving] = [0, true];
  const hand = (async () => {
    while (moving) {
      turn += 0.05;
      const moved = { type: 'mouseMoved', ...path(turn), button: 'left', buttons: 1 } as const;
      // A slow page may be closed before the last of them are taken.
      client.send('Input.dispatchMouseEvent', moved).catch(() => undefined);
      await new Promise((resolve) => setTimeout(resolve, 8));
    }
  })();
  const measured = await measure(page);
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

/** Moves along the whole show and back, again and again. */
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

/** A crowd of `robots` robots, on the page for editing; `scenes` are measured. */
async function withCrowd(
  robots: number,
  layers: readonly object[],
  scenes: (page: Page, live: () => Promise<unknown>) => Promise<void>,
) {
  const file = join(folder, `crowd ${robots} ${layers.length}.lightbots.json`);
  writeFileSync(file, crowdShow(robots, layers));
  const server = await startServer(file, '--robots', String(robots));
  try {
    const page = await openPage(browser, server, 'edit', {}, noteDraws);
    await page.getByTestId('stage').waitFor();
    await page.getByText(`${robots} robots`, { exact: true }).waitFor();
    await scenes(page, () => page.goto(`${server.url}/#/live`));
    await page.close();
  } finally {
    await server.remove();
  }
}

for (const robots of [30, 100, 1000, 10_000])
  test(`frames a second with ${robots} robots`, () =>
    withCrowd(robots, [], async (page, live) => {
      // One scene that fails does not cost the other.
      const edited =
        robots <= 1000 ? await Promise.allSettled([dragAll(page, robots, 'drag all')]) : [];
      await live();
      await watch(page, robots, 'watch live');
      for (const scene of edited) if (scene.status === 'rejected') throw scene.reason;
    }));

for (const robots of [30, 100, 1000])
  test(`frames a second with light on ${robots} robots`, () =>
    withCrowd(robots, LAYERS, async (page, live) => {
      // The stage shows light of the frame on it while the panel of layers is open.
      await page.getByRole('tab', { name: 'Light' }).click();
      await page.getByRole('list', { name: 'Layers, the uppermost first' }).waitFor();
      const edited = await Promise.allSettled([dragAll(page, robots, 'drag all, light')]);
      edited.push(...(await Promise.allSettled([scrub(page, robots, 'scrub, light')])));
      await live();
      await watch(page, robots, 'watch live, light');
      for (const scene of edited) if (scene.status === 'rejected') throw scene.reason;
    }));
