import { defineConfig } from 'vitest/config';

/** Times the module of the browser: `cargo xtask bench preview browser-plan` runs it. */
export default defineConfig({
  test: {
    include: ['bench/preview.ts', 'bench/plan.ts'],
    environment: 'node',
    testTimeout: 300_000,
    hookTimeout: 120_000,
    disableConsoleIntercept: true,
    reporters: ['dot'],
  },
});
