import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';

/** As long as anything may take on a slow, busy machine, milliseconds. */
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 90_000);

/** The folder of a built screen to try in place of the one in the program, which need not be built anew then. */
const screen = process.env.LIGHTBOTS_SCREEN;

const CHROMIUM_ARGS = [
  '--no-sandbox',
  '--disable-gpu',
  '--disable-dev-shm-usage',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  // What a test serves by itself counts as foreign, and would not be let at the server's socket.
  ...(screen ? ['--disable-features=LocalNetworkAccessChecks'] : []),
];

/** The program under test, by `LIGHTBOTS_BIN`. */
function program(): string {
  const path = process.env.LIGHTBOTS_BIN;
  if (!path) throw new Error('Set LIGHTBOTS_BIN to a built lightbots program.');
  return path;
}

/** Chromium, by `CHROMIUM` or where Linux systems keep it. */
function browserPath(): string {
  const places = [
    process.env.CHROMIUM,
    '/usr/bin/chromium',
    '/usr/bin/chromium-browser',
    '/usr/bin/google-chrome',
  ];
  const found = places.find((place) => place && existsSync(place));
  if (!found) throw new Error('No Chromium found; set CHROMIUM to its program.');
  return found;
}

export interface Server {
  url: string;
  /** Its library, gone after `remove`. */
  data: string;
  /** Its process now. */
  pid(): number;
  /** What it has printed since its last start, up to 20,000 characters. */
  said(): string;
  /** Ends it, as a crash does. */
  kill(): Promise<void>;
  /** Starts it again on the same address and library. */
  restart(): Promise<void>;
  remove(): Promise<void>;
}

/** Starts `lightbots run` with an embedded broker and simulated robots on free ports. */
export async function startServer(...more: string[]): Promise<Server> {
  const data = mkdtempSync(join(tmpdir(), 'lightbots-'));
  const base = ['run', '--data', data, '--mqtt-listen', '127.0.0.1:0', '--seed', '7', ...more];
  const listen = more.includes('--listen') ? [] : ['--listen', '127.0.0.1:0'];
  const first = await launch([...base, ...listen]);
  const url = first[1];
  let [child, , said] = first;
  const server: Server = {
    url,
    data,
    pid: () => child.pid ?? 0,
    said: () => said(),
    kill: () => end(child),
    async restart() {
      [child, , said] = await launch([...base, '--listen', new URL(url).host]);
    },
    async remove() {
      await end(child);
      rmSync(data, { recursive: true, force: true });
    },
  };
  return server;
}

/** The part of the first operator's address that a server prints: `#first=…`. */
export const firstAddress = (server: Server): Promise<string> =>
  eventually(
    async () => /#first=[0-9a-f]+/.exec(server.said())?.[0] ?? '',
    (found) => found !== '',
    'a one-time address',
  );

/** Processes that tests started beside the server. */
const others = new Set<ChildProcess>();

/** Ends the robots and brokers that tests of this file started and left. */
export async function endOthers(): Promise<void> {
  await Promise.all([...others].map(end));
  others.clear();
}

export interface Broker {
  url: string;
  /** Ends it, as a crash does. */
  kill(): Promise<void>;
  /** Starts it again on the same address. */
  restart(): Promise<void>;
}

/** Starts a broker of its own process on a free port. */
export async function startBroker(): Promise<Broker> {
  const start = async (port: string) => {
    const child = spawn(program(), ['broker', '--mqtt-listen', `127.0.0.1:${port}`], {
      stdio: ['ignore', 'pipe', 'pipe'],
    });
    others.add(child);
    const address = await new Promise<string>((resolve, reject) => {
      let said = '';
      const read = (bytes: Buffer) => {
        said += bytes.toString();
        const url = /mqtt:\/\/[\d.]+:\d+/.exec(said)?.[0];
        if (url) resolve(url);
      };
      child.stdout.on('data', read);
      child.stderr.on('data', read);
      child.on('exit', (code) => reject(new Error(`The broker ended with ${code}: ${said}`)));
    });
    return { child, address };
  };
  let { child, address } = await start('0');
  return {
    url: address,
    kill: () => end(child),
    async restart() {
      ({ child, address } = await start(new URL(address.replace('mqtt:', 'http:')).port));
    },
  };
}

/** Ends robots, as a power cut does. */
export interface OtherRobots {
  (): Promise<void>;
  /** Their process. */
  pid: number;
}

/** Robots of a process of their own on a broker, or a server's. */
export async function startRobots(
  on: Server | Broker,
  count: number,
  more: readonly string[] = ['--seed', '11'],
): Promise<OtherRobots> {
  const broker = 'data' in on ? await embeddedBroker(on) : on.url;
  const args = ['robots', '--count', String(count), '--broker', broker, ...more];
  const child = spawn(program(), args, { stdio: 'ignore' });
  others.add(child);
  return Object.assign(() => end(child), { pid: child.pid ?? 0 });
}

async function embeddedBroker(server: Server): Promise<string> {
  const settings = await fetch(`${server.url}/api/broker`);
  return ((await settings.json()) as { embedded: string }).embedded;
}

function launch(args: string[]): Promise<[ChildProcess, string, () => string]> {
  const child = spawn(program(), args, { stdio: ['ignore', 'pipe', 'pipe'] });
  return new Promise((resolve, reject) => {
    let said = '';
    const timer = setTimeout(
      () => reject(new Error(`No address after ${PATIENCE_MS} ms: ${said}`)),
      PATIENCE_MS,
    );
    const read = (bytes: Buffer) => {
      said += bytes.toString();
      // The first lines have addresses, and the last ones say what went wrong.
      if (said.length > 40_000) said = said.slice(0, 20_000) + said.slice(-10_000);
      const url = /https?:\/\/[\d.]+:\d+/.exec(said)?.[0];
      if (!url) return;
      clearTimeout(timer);
      resolve([child, url, () => said]);
    };
    child.stdout.on('data', read);
    child.stderr.on('data', read);
    child.on('exit', (code) => reject(new Error(`The server ended with ${code}: ${said}`)));
  });
}

function end(child: ChildProcess): Promise<void> {
  if (child.exitCode !== null || child.signalCode !== null) return Promise.resolve();
  return new Promise((resolve) => {
    child.on('exit', () => resolve());
    child.kill('SIGKILL');
  });
}

/** A browser; `sound`: what its environment needs to be heard. */
export const launchBrowser = (sound?: Record<string, string>): Promise<Browser> =>
  chromium.launch({
    executablePath: browserPath(),
    args: CHROMIUM_ARGS,
    env: { ...process.env, ...sound },
    // Hidden tabs are slowed as everywhere.
    ignoreDefaultArgs: [
      '--disable-renderer-backgrounding',
      '--disable-background-timer-throttling',
      ...(sound ? ['--mute-audio'] : []),
    ],
    timeout: PATIENCE_MS,
  });

/** What went wrong inside pages; every suite ends by finding it empty. */
export const mistakes: string[] = [];

/** A page that has seen the tour, of a size a laptop has; `before` runs in it first. */
export async function openPage(
  browser: Browser,
  server: Server,
  view: 'live' | 'edit' = 'live',
  options: BrowserContextOptions & { tour?: boolean; scheme?: string } = {},
  before?: () => void,
): Promise<Page> {
  const { tour, scheme, ...context } = options;
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, ...context });
  page.setDefaultTimeout(PATIENCE_MS);
  page.on('pageerror', (error) => mistakes.push(String(error)));
  page.on('console', (said) => {
    if (said.text().includes('Content Security Policy')) mistakes.push(said.text());
  });
  if (!tour)
    await page.addInitScript(() => {
      // A page that could not be loaded has no storage.
      if (location.protocol === 'http:') localStorage.setItem('lightbots-tour', 'done');
    });
  if (scheme)
    await page.addInitScript((value) => {
      if (location.protocol === 'http:') localStorage.setItem('mantine-color-scheme-value', value);
    }, scheme);
  if (before) await page.addInitScript(before);
  await serveScreen(page, server);
  await page.goto(`${server.url}/#/${view}`);
  await page.getByText('Connected', { exact: true }).waitFor();
  return page;
}

async function serveScreen(page: Page, server: Server): Promise<void> {
  if (!screen) return;
  // The files are other ones, the rules for them are the server's.
  const answer = await page.context().request.get(server.url);
  const policy = answer.headers()['content-security-policy'] ?? '';
  const headers = { 'content-security-policy': policy };
  // For windows that the page opens, too.
  await page.context().route(
    (url) => url.origin === server.url && !/^\/(api|ws)\b/.test(url.pathname),
    (route) => {
      const { pathname } = new URL(route.request().url());
      return route.fulfill({
        path: join(screen, pathname === '/' ? 'index.html' : pathname),
        headers,
      });
    },
  );
}

/** Waits until what `read` gives passes. */
export async function eventually<T>(
  read: () => Promise<T>,
  passes: (value: T) => boolean,
  what: string,
): Promise<T> {
  const until = Date.now() + PATIENCE_MS;
  for (;;) {
    const value = await read();
    if (passes(value)) return value;
    if (Date.now() > until)
      throw new Error(`Never came true: ${what}; last ${JSON.stringify(value)}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}
