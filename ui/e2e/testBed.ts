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

/** What a failed test left: the text of its pages, and what the server said last. */
async function remains(pages: readonly Page[], server: Server): Promise<string> {
  const shows = async (page: Page) => {
    const text = await page.locator('body').innerText({ timeout: 5_000 }).catch(String);
    return `${page.url()} shows:\n${text.slice(0, 4_000)}`;
  };
  const said = `The server said last:\n${server.said().slice(-2_000)}`;
  return [...(await Promise.all(pages.map(shows))), said].join('\n');
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
  afterEach(async ({ task }) => {
    const open = pages.splice(0);
    // The message of the error stands in the summary, which comes last.
    const error = task.result?.errors?.[0];
    if (error) error.message += `\n${await remains(open, there(server))}`;
    await Promise.all(open.map((page) => page.close()));
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
