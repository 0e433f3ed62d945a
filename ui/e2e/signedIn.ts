import type { Browser, Page } from 'playwright-core';
import { firstAddress, openPage, startServer, type Server } from './harness';

const PASSWORD = 'a long password';

/** Starts a server on the network that asks for sign-in, with an operator, an editor and a viewer, named so. */
export async function startSignInServer(...more: string[]): Promise<Server> {
  const server = await startServer('--listen', '0.0.0.0:0', '--plain-http', ...more);
  const token = (await firstAddress(server)).replace('#first=', '');
  const post = (path: string, body: unknown, cookie = '') =>
    fetch(`${server.url}${path}`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json', Origin: server.url, Cookie: cookie },
      body: JSON.stringify(body),
    });
  const first = await post('/api/first', { token, name: 'operator', password: PASSWORD });
  const cookie = first.headers.get('set-cookie')?.split(';')[0] ?? '';
  for (const role of ['editor', 'viewer']) {
    const added = await post('/api/people', { name: role, role, password: PASSWORD }, cookie);
    if (!added.ok) throw new Error(`No ${role}: ${await added.text()}`);
  }
  return server;
}

/** Opens a page of a signed-in person with this role. */
export async function openAs(
  browser: Browser,
  server: Server,
  role: 'viewer' | 'editor' | 'operator',
): Promise<Page> {
  const signIn = await browser.newContext();
  const answer = await signIn.request.post(`${server.url}/api/session`, {
    data: { name: role, password: PASSWORD },
    headers: { Origin: server.url },
  });
  if (!answer.ok()) throw new Error(`${role} cannot sign in: ${await answer.text()}`);
  const storageState = await signIn.storageState();
  await signIn.close();
  return openPage(browser, server, 'live', { storageState });
}
