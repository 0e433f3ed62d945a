import { expect, test } from 'vitest';
import type { Issue, Severity } from '../api/types.gen';
import { freeName, importedLines, nameFromFile } from './upload';

test('names come from files', () => {
  expect(nameFromFile('3210.json')).toBe('3210');
  expect(nameFromFile('My stars.lightbots.json')).toBe('My stars');
  expect(nameFromFile('../../etc/passwd')).toBe('.. .. etc passwd');
  expect(nameFromFile('.json')).toBe('Show');
});

test('a taken name gets a number', () => {
  expect(freeName('Heart', ['heart', 'Heart 2'])).toBe('Heart 3');
  expect(freeName('Heart', [])).toBe('Heart');
});

test('what an import leaves out is named, and stays on the screen', () => {
  const issue = (severity: Severity, message: string): Issue => ({
    code: 'x',
    severity,
    frame: null,
    pixels: [],
    message,
  });
  expect(importedLines({ name: 'A', issues: [issue('note', 'By the way.')] })).toEqual([
    'good',
    ['Imported and opened "A".'],
  ]);
  const issues = [1, 2, 3, 4, 5, 6].map((n) => issue('warning', `loss ${n}`));
  const [tone, lines] = importedLines({ name: 'A', issues });
  expect([tone, ...lines.slice(1)]).toEqual([
    'warning',
    'Loss 1.',
    'Loss 2.',
    'Loss 3.',
    'Loss 4.',
    '2 more.',
  ]);
});
