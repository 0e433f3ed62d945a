import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { findings } from './axe';
import {
  endOthers,
  firstAddress,
  PATIENCE_MS,
  startBroker,
  startRobots,
  startServer,
  type Broker,
} from './harness';
import { phaseIs, smallShow } from './journeys';
import { createBrowserBed } from './testBed';
import { createHand, type Hand, type Means } from './hand';

/** Width and height of the screen, CSS pixels, the device that operates it, and its colours. */
const SCREENS: [number, number, Means, 'dark' | 'light'][] = [
  [1440, 900, 'keyboard', 'dark'],
  [720, 450, 'mouse', 'light'],
  [390, 844, 'touch', 'dark'],
  [1024, 768, 'touch', 'light'],
];

/** A person at a screen, on a night with a broker of its own. */
interface Night {
  page: Page;
  hand: Hand;
  broker: Broker;
  /** Waits until a text is seen. */
  see(text: string | RegExp): Promise<void>;
  /** Checks that the page is not wider than the screen; saves a picture if `SHOTS` names a folder. */
  look(what: string): Promise<void>;
}

const bed = createBrowserBed('night');
const show = join(bed.folder, 'night.lightbots.json');
writeFileSync(show, smallShow(6, 60));

async function signIn({ page, hand, look }: Night, address: string) {
  await page.goto(address);
  await hand.type(page.getByLabel('Name'), 'ann');
  await hand.type(page.getByLabel('Password', { exact: true }), 'a long password');
  await hand.push('Make the first operator');
  await page.waitForEvent('load');
  await look('signed-in');
}

/** Starts six known robots and lets a seventh join; answers what ends one of them, and what ends three. */
async function admitRobots({ page, hand, broker, see, look }: Night) {
  const robots = (seed: string, ...places: string[]) =>
    startRobots(broker, places.length, ['--seed', seed, '--start', places.join(' ')]);
  await robots('11', '-0.9,1.2', '-0.7,1.2');
  const endOne = await robots('12', '-0.5,1.2');
  const endThree = await robots('13', '-0.1,1.2', '0.1,1.2', '0.3,1.2');
  await see('6 robots');
  await hand.push('Settings');
  await hand.press(page.getByRole('switch', { name: 'Ask before new robots take part' }));
  await page.keyboard.press('Escape');
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
  await robots('14', '0.9,1.2');
  await see(/is new and wants to join/);
  await look('new-robot');
  expect(await findings(page)).toEqual([]);
  await hand.push('Let it join');
  await hand.push('Places…');
  const places = page.getByRole('dialog', { name: 'Compare places' });
  await see(/of 7 robots in their starting places/);
  await look('places');
  await hand.press(places.getByRole('button', { name: 'Close', exact: true }).last());
  await places.waitFor({ state: 'hidden' });
  return [endOne, endThree] as const;
}

async function loseRobots(
  { page, hand, see, look }: Night,
  [endOne, endThree]: readonly [() => Promise<void>, () => Promise<void>],
) {
  await hand.push(/^Play$/);
  await see('Playing frame 1 of 2');
  await look('playing');
  await endOne();
  await see(/^Robot \S+ fell silent in frame 1/);
  await look('one-lost');
  await endThree();
  await see('3 of 6 robots fell silent at once: this is the link, not the robots.');
  await look('three-lost');
  expect(await findings(page)).toEqual([]);
  await hand.push(/^Go on$/);
  await see(/^Playing frame/);
}

async function loseBroker({ page, broker, see, look }: Night) {
  await broker.kill();
  await see('The broker is lost.');
  await look('no-broker');
  expect(await findings(page)).toEqual([]);
  await broker.restart();
  await see(/^Playing frame/);
}

async function stopAndGoHome({ page, hand, see, look }: Night) {
  await hand.push(/^Stop all/);
  await phaseIs(page, 'ready');
  await look('stopped');
  expect(await findings(page)).toEqual([]);
  await hand.push('Play on from frame 1');
  // Four robots are silent; the checklist names that first.
  await look('checklist');
  await hand.push('Play with 3 robots');
  await see(/^Playing frame/);
  await hand.push(/^Stop all/);
  await phaseIs(page, 'ready');
  await hand.push(/^Home$/);
  await see('Driving home');
  await look('home');
  await phaseIs(page, 'ready');
}

async function readReport({ page, hand }: Night, width: number, height: number) {
  const link = page.getByRole('link', { name: 'Read the report' }).filter({ visible: true });
  const [report] = await Promise.all([
    page.context().waitForEvent('page', { timeout: PATIENCE_MS }),
    hand.press(link.first()),
  ]);
  await report.setViewportSize({ width, height });
  await report.getByRole('heading', { name: /^Stopped/ }).waitFor();
  const wide = await report.evaluate(() => document.documentElement.scrollWidth);
  expect(wide).toBeLessThanOrEqual(width);
  if (process.env.SHOTS)
    await report.screenshot({ path: `${process.env.SHOTS}/night-${width}-report.png` });
  expect(await findings(report)).toEqual([]);
}

for (const [width, height, means, scheme] of SCREENS)
  test(`a night at ${width} × ${height} by ${means}`, async () => {
    const broker = await startBroker();
    const there = ['--listen', '0.0.0.0:0', '--robots', '0', '--broker', broker.url];
    const server = await startServer(show, ...there);
    const page = await bed.browser.newPage({
      ignoreHTTPSErrors: true,
      viewport: { width, height },
      hasTouch: means === 'touch',
    });
    page.setDefaultTimeout(PATIENCE_MS);
    await page.addInitScript((value) => {
      localStorage.setItem('lightbots-tour', 'done');
      localStorage.setItem('mantine-color-scheme-value', value);
    }, scheme);
    let pictures = 0;
    const night: Night = {
      page,
      hand: createHand(page, means),
      broker,
      see: (text) => page.getByText(text).filter({ visible: true }).first().waitFor(),
      async look(what) {
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        expect(wide).toBeLessThanOrEqual(width);
        const name = `night-${width}-${++pictures}-${what}.png`;
        if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/${name}` });
      },
    };
    await signIn(night, `${server.url}/${await firstAddress(server)}`);
    const ends = await admitRobots(night);
    await loseRobots(night, ends);
    await loseBroker(night);
    await stopAndGoHome(night);
    await readReport(night, width, height);
    await page.close();
    await server.remove();
    await endOthers();
  });
