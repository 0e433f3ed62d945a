import { defineConfig } from 'vitest/config';

/** Whole journeys in a real browser against the real server: see e2e/harness.ts for what they need. */
export default defineConfig({
  test: {
    include: ['e2e/**/*.e2e.ts'],
    environment: 'node',
    fileParallelism: false,
    testTimeout: 240_000,
    hookTimeout: 120_000,
  },
});
