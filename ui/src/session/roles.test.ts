import { expect, test } from 'vitest';
import { whyNot } from './roles';

test('a role that is not enough is told the one that is', () => {
  expect(whyNot('viewer', 'operator', 'press Play')).toBe(
    'Your role is viewer. An operator can press Play.',
  );
  expect(whyNot('operator', 'editor', 'change shows')).toBe(null);
  expect(whyNot('editor', 'editor', 'change shows')).toBe(null);
});
