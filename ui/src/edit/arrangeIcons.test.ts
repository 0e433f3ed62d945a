import { createElement } from 'react';
import { renderToStaticMarkup } from 'react-dom/server';
import { expect, test } from 'vitest';
import { MOVES } from './ArrangeSection';

/** The first path of an icon of `MOVES`, as SVG: of a mirror icon the straight line between its halves. */
const axisOf = (label: string) => {
  const Glyph = MOVES.find(([name]) => name === label)?.[1];
  if (!Glyph) throw new Error(`There is no ${label}.`);
  return / d="([^"]+)"/.exec(renderToStaticMarkup(createElement(Glyph)))?.[1];
};

test('the icon of a mirror shows the axis it mirrors at', () => {
  expect(axisOf('Mirror left and right'), 'upright').toBe('M12 3l0 18');
  expect(axisOf('Mirror top and bottom'), 'level').toBe('M3 12l18 0');
});
