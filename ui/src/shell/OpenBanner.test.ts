import { createElement } from 'react';
import { renderToStaticMarkup } from 'react-dom/server';
import { expect, test } from 'vitest';
import { createLive, receive } from '../session/live';
import { OpenBanner } from './OpenBanner';
import { SessionContext, type Session } from '../session/session';

test('a server that the network reaches without TLS says so until it is not', () => {
  const live = createLive();
  const value = { live } as Session;
  const shown = () =>
    renderToStaticMarkup(createElement(SessionContext, { value }, createElement(OpenBanner)));
  const greet = (plain_http: boolean) =>
    receive(live, { type: 'hello', version: '1', screen: 1, simulated: 0, plain_http });
  expect(shown()).toBe('');
  greet(true);
  expect(shown()).toContain('passwords can be read on the way');
  greet(false);
  expect(shown()).toBe('');
});
