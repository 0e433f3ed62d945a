import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { endOthers, launchBrowser, mistakes, openPage, startServer, type Server } from './harness';

type View = Parameters<typeof openPage>[2];
type Options = Parameters<typeof openPage>[3];

/** What a file of tests stands on: one server and one browser for all of them. */
export interface TestBed {
  readonly browser: Browser;
  readonly server: Server;
  /** A page of that server, closed when the test is over. */
  open(view?: View, options?: Options): Promise<Page>;
}

/** Starts `lightbots run` with these arguments and a browser before the tests of a file, and ends both after them. */
export function createTestBed(...serverArguments: string[]): TestBed {
  let browser: Browser | undefined;
  let server: Server | undefined;
  const pages: Page[] = [];
  const there = <T>(part: T | undefined): T => {
    if (part === undefined) throw new Error('It is there only while tests run.');
    return part;
  };
  beforeAll(async () => {
    [server, browser] = await Promise.all([startServer(...serverArguments), launchBrowser()]);
  });
  afterEach(async () => {
    await Promise.all(pages.splice(0).map((page) => page.close()));
  });
  afterAll(async () => {
    await browser?.close();
    await server?.remove();
    await endOthers();
    expect(mistakes).toEqual([]);
  });
  return {
    get browser() {
      return there(browser);
    },
    get server() {
      return there(server);
    },
    async open(view, options) {
      const page = await openPage(there(browser), there(server), view, options);
      pages.push(page);
      return page;
    },
  };
}

/** What a file of tests stands on that starts servers of its own: a browser, and a folder for files. */
export function createBrowserBed(name: string) {
  let browser: Browser | undefined;
  const folder = mkdtempSync(join(tmpdir(), `lightbots-${name}-`));
  beforeAll(async () => {
    browser = await launchBrowser();
  });
  afterAll(async () => {
    await browser?.close();
    await endOthers();
    rmSync(folder, { recursive: true, force: true });
  });
  return {
    folder,
    get browser() {
      if (!browser) throw new Error('It is there only while tests run.');
      return browser;
    },
  };
}
