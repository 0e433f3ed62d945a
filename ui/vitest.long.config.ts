import { defineConfig } from 'vitest/config';

/** Half an hour of a show in three pages: `cargo xtask bench long-run` runs it. */
export default defineConfig({
  test: {
    include: ['e2e/longRun.ts'],
    environment: 'node',
    testTimeout: 3_600_000,
    hookTimeout: 120_000,
    disableConsoleIntercept: true,
    reporters: ['dot'],
  },
});
