import { defineConfig } from 'vitest/config';

/** Compares what is heard with the show: `cargo xtask bench sound` runs it. */
export default defineConfig({
  test: {
    include: ['e2e/soundRun.ts'],
    environment: 'node',
    testTimeout: 900_000,
    hookTimeout: 120_000,
    disableConsoleIntercept: true,
    reporters: ['dot'],
  },
});
