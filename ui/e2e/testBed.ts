import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { endOthers, launchBrowser, mistakes, openPage, startServer, type Server } from './harness';

type View = Parameters<typeof openPage>[2];
type Options = Parameters<typeof openPage>[3];

/** One server and one browser for all tests of a file. */
export interface TestBed {
  readonly browser: Browser;
  readonly server: Server;
  /** Opens a page of that server, which is closed when the test is over. */
  open(view?: View, options?: Options): Promise<Page>;
}

/** The texts of a failed test's pages and the end of the server's output. */
async function remains(pages: readonly Page[], server: Server): Promise<string> {
  const shows = async (page: Page) => {
    const text = await page.locator('body').innerText({ timeout: 5_000 }).catch(String);
    return `${page.url()} shows:\n${text.slice(0, 4_000)}`;
  };
  const said = `The server said last:\n${server.said().slice(-2_000)}`;
  return [...(await Promise.all(pages.map(shows))), said].join('\n');
}

/**
 * Starts `lightbots run` with these arguments and a browser before the tests of a file, and ends both after them. Then
 * it checks that there were no `mistakes`.
 */
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
    // The summary, which comes last, contains the error's message.
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

/** A browser and a folder for files, both removed at the end, for a file of tests that starts servers of its own. */
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
