import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';

/** Longest wait for anything, milliseconds; enough for a slow, busy machine. */
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 90_000);

/** Folder of a built screen that is served in place of the one in the program; undefined: none. */
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
  // A screen that the test serves counts as foreign; by default the browser does not let it connect to the server.
  ...(screen ? ['--disable-features=LocalNetworkAccessChecks'] : []),
];

/** Path of the program under test, from `LIGHTBOTS_BIN`. */
function program(): string {
  const path = process.env.LIGHTBOTS_BIN;
  if (!path) throw new Error('Set LIGHTBOTS_BIN to a built lightbots program.');
  return path;
}

/** Path of Chromium: from `CHROMIUM`, else the first usual path on Linux that exists. */
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
  /** Folder of its data, deleted by `remove`. */
  data: string;
  /** Id of its present process. */
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

/** Waits for the one-time part, `#first=…`, of the address that a server prints for the first operator. */
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

/** Starts a broker in a process of its own, on a free port. */
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

/** Ends the robots, as a power cut does. */
export interface OtherRobots {
  (): Promise<void>;
  /** Id of their process. */
  pid: number;
}

/** Starts `count` simulated robots in a process of their own, on a broker or on a server's embedded broker. */
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
      // The first lines have addresses, the last ones errors.
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

/** Starts a browser; `sound`: environment variables with which it can be heard; without them it is muted. */
export const launchBrowser = (sound?: Record<string, string>): Promise<Browser> =>
  chromium.launch({
    executablePath: browserPath(),
    args: CHROMIUM_ARGS,
    env: { ...process.env, ...sound },
    // Without these default arguments, hidden tabs are slowed as in people's browsers.
    ignoreDefaultArgs: [
      '--disable-renderer-backgrounding',
      '--disable-background-timer-throttling',
      ...(sound ? ['--mute-audio'] : []),
    ],
    timeout: PATIENCE_MS,
  });

/** Errors inside pages, and violations of their security policy; at the end of most suites there must be none. */
export const mistakes: string[] = [];

/** Opens a page and waits for its connection. Without `tour`, the tour counts as seen. `before` runs in it first. */
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
  // The files are others, but they are served with the server's security policy.
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

/** Reads every 100 ms until a value passes, and answers it. Throws after `PATIENCE_MS`, naming `what`. */
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
