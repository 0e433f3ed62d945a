import { createElement } from 'react';
import { renderToStaticMarkup } from 'react-dom/server';
import { expect, test } from 'vitest';
import { createLive, receive } from '../session/live';
import { OpenBanner } from './OpenBanner';
import { SessionContext, type Session } from '../session/session';

test('a server that is open to the network says so until it is not', () => {
  const live = createLive();
  const value = { live } as Session;
  const shown = () =>
    renderToStaticMarkup(createElement(SessionContext, { value }, createElement(OpenBanner)));
  const greet = (open_to_network: boolean) =>
    receive(live, { type: 'hello', version: '1', screen: 1, simulated: 0, open_to_network });
  expect(shown()).toBe('');
  greet(true);
  expect(shown()).toContain('passwords can be read on the way');
  greet(false);
  expect(shown()).toBe('');
});
