import { defineConfig } from 'vitest/config';

/** Counts frames a second: `cargo xtask bench fps` runs it. */
export default defineConfig({
  test: {
    include: ['e2e/fps.ts'],
    environment: 'node',
    testTimeout: 300_000,
    hookTimeout: 120_000,
    disableConsoleIntercept: true,
    reporters: ['dot'],
  },
});
