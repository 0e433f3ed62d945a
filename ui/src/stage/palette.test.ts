import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { FLOOR } from './palette';

test('canvases and style sheets use the same colours of the floor', () => {
  const tokens = readFileSync(new URL('../style/tokens.css', import.meta.url), 'utf8');
  for (const [name, colour] of Object.entries(FLOOR)) {
    const token = name.replace(/([A-Z]|\d)/g, '-$1').toLowerCase();
    const wanted = token === 'floor' ? '--floor' : `--floor-${token}`;
    expect(tokens).toContain(`${wanted}: ${colour};`);
  }
});
