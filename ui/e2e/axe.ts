import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Serious and critical violations that axe finds, one line each; waits first for short animations to end. */
export async function findings(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    // While an element fades in, its contrast is smaller than afterwards; the fade may not have begun yet.
    const areFading = () =>
      document.getAnimations().some((one) => {
        const end = one.effect?.getComputedTiming().endTime;
        return one.playState === 'running' && typeof end === 'number' && end < 2000;
      });
    let still = 0;
    for (let look = 0; look < 100 && still < 4; look++) {
      await new Promise((resolve) => setTimeout(resolve, 50));
      still = areFading() ? 0 : still + 1;
    }
    const run = (globalThis as unknown as { axe: { run(): Promise<AxeResult> } }).axe.run;
    const { violations } = await run();
    return violations
      .filter((v) => v.impact === 'serious' || v.impact === 'critical')
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 160)).join(' | ')}`);
  });
}

interface AxeResult {
  violations: { id: string; impact: string; nodes: { html: string }[] }[];
}
