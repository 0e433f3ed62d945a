import { expect, test } from 'vitest';
import { freeName, nameFromFile } from './upload';

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
