import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { findings } from './axe';
import { eventually, firstAddress, launchBrowser, startServer, type Server } from './harness';

let server: Server;
let browser: Browser;
const PASSWORD = 'a long password';

beforeAll(async () => {
  const network = ['--listen', '0.0.0.0:0', '--robots', '4'];
  [server, browser] = await Promise.all([startServer(...network), launchBrowser()]);
});
afterAll(async () => {
  await browser.close();
  await server.remove();
});

/** Opens the sign-in page or the one-time address, in a browser context of its own. */
async function arrive(address = ''): Promise<Page> {
  const context = await browser.newContext({
    ignoreHTTPSErrors: true,
    viewport: { width: 1440, height: 900 },
  });
  const page = await context.newPage();
  await page.goto(`${server.url}/${address}`);
  return page;
}

async function submit(page: Page, name: string, button: string) {
  await page.getByLabel('Name').fill(name);
  await page.getByLabel('Password', { exact: true }).fill(PASSWORD);
  await page.getByRole('button', { name: button }).click();
  await page.getByText('Connected', { exact: true }).waitFor();
}

test('an operator adds a viewer, who may stop and is told why nothing else, and removes the viewer', async () => {
  const token = await firstAddress(server);
  const ann = await arrive(token);
  await submit(ann, 'ann', 'Make the first operator');
  await ann.getByRole('button', { name: 'Settings' }).click();
  await ann.getByRole('button', { name: 'People and tokens…' }).click();
  const add = ann.getByRole('form', { name: 'Add a person' });
  await add.getByLabel('Name').fill('bob');
  await add.getByLabel('Password', { exact: true }).fill(PASSWORD);
  await add.getByRole('button', { name: 'Add' }).click();
  await ann.getByLabel('Role of bob').waitFor();
  expect(await findings(ann)).toEqual([]);
  await ann.getByLabel('Role of ann').selectOption('viewer');
  await ann.getByText('ann is the last operator').waitFor();
  expect(await ann.getByLabel('Role of ann').inputValue()).toBe('operator');

  const bob = await arrive();
  await submit(bob, 'bob', 'Sign in');
  const play = bob.getByRole('button', { name: 'Play', exact: true });
  await bob
    .getByRole('note')
    .getByText('Your role is viewer. An operator can press Play.')
    .waitFor();
  expect(await play.isDisabled()).toBe(true);
  expect(await bob.getByRole('button', { name: 'Identify robot' }).first().isDisabled()).toBe(true);
  expect(await findings(bob)).toEqual([]);
  if (process.env.SHOTS) await bob.screenshot({ path: `${process.env.SHOTS}/viewer.png` });
  await bob.keyboard.press('Space');
  const stop = bob.getByTestId('stop-all');
  expect(await stop.isEnabled()).toBe(true);
  await stop.click();

  // The page learns its new role with its next connection.
  await ann.getByLabel('Role of bob').selectOption('operator');
  await bob.reload();
  await eventually(
    () => play.isDisabled(),
    (disabled) => !disabled,
    'an operator can play',
  );
  await ann.getByRole('tab', { name: 'Tokens of programs' }).click();
  await ann.getByLabel('Name of the program').fill('lights');
  await ann.getByRole('button', { name: 'Make a token' }).click();
  const secret = (await ann.getByTestId('token').textContent()) ?? '';
  const program = (await browser.newContext({ ignoreHTTPSErrors: true })).request;
  const headers = { Authorization: `Bearer ${secret}` };
  const status = async () => (await program.get(`${server.url}/api/shows`, { headers })).status();
  expect(await status()).toBe(200);
  await ann.getByRole('button', { name: 'Revoke the token lights' }).click();
  await eventually(status, (now) => now === 401, 'a revoked token opens nothing');

  await ann.getByRole('tab', { name: 'People' }).click();
  await ann.getByRole('button', { name: 'Remove bob' }).click();
  await ann.getByRole('button', { name: 'Remove bob' }).last().click();
  await bob.getByRole('heading', { name: 'Sign in' }).waitFor();
  await ann.getByLabel('Role of bob').waitFor({ state: 'detached' });
  if (process.env.SHOTS) await ann.screenshot({ path: `${process.env.SHOTS}/people.png` });
});
