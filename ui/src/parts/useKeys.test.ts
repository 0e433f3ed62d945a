import { expect, test } from 'vitest';
import { isTaken, type Focused } from './useKeys';

/** An element that matches the selectors in `is`, without parents. */
const element = (tagName: string, is: string[], type?: string): Focused => ({
  tagName,
  type,
  isContentEditable: false,
  closest: (selectors: string) =>
    (selectors.split(', ').some((s) => is.includes(s)) ? ({} as Element) : null) as never,
});
const BUTTON = element('BUTTON', ['button']);
const SEGMENT = element('INPUT', ['input'], 'radio');

test.each<[string, Focused | null, boolean, boolean]>([
  ['the page', null, true, false],
  ['a button that was clicked', BUTTON, false, false],
  ['a button that was tabbed to', BUTTON, true, true],
  ['a segment that was clicked', SEGMENT, false, false],
  ['a segment that was tabbed to', SEGMENT, true, true],
  ['a tab that was clicked', element('BUTTON', ['button', '[role="tab"]']), false, false],
  ['a text field', element('INPUT', ['input'], 'text'), false, true],
  ['a menu', element('BUTTON', ['button', '[role="menu"]']), false, true],
  ['the floor, tabbed to', element('CANVAS', []), true, false],
])('Space belongs to what has the focus: %s', (_, focused, byKeyboard, taken) => {
  expect(isTaken(focused, ' ', byKeyboard)).toBe(taken);
});

test('arrows belong to choices and sliders, letters to the view', () => {
  const slider = element('DIV', ['[role="slider"]']);
  expect([isTaken(slider, 'ArrowLeft', false), isTaken(slider, 'p', true)]).toEqual([true, false]);
  expect([isTaken(SEGMENT, 'End', false), isTaken(SEGMENT, 'p', true)]).toEqual([true, false]);
});
