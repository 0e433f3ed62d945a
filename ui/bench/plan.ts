import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import type { PlanAnswer } from '../src/api/types.gen';
import { initSync, plan } from '../src/generated/browser';
import { medianOf } from './median';

/** The program that plans natively and writes the same requests. */
const NATIVE = process.env.LIGHTBOTS_NATIVE_PLANS ?? '';

interface Native {
  robots: number;
  native_ms: number;
}

test('plans by the WebAssembly module, as in the browser', async () => {
  const file = new URL('../src/generated/browser_bg.wasm', import.meta.url);
  initSync({ module: readFileSync(file) });
  const folder = mkdtempSync(join(tmpdir(), 'lightbots-plans-'));
  try {
    const lines = execFileSync(NATIVE, [folder], { encoding: 'utf8' }).trim().split('\n');
    for (const { robots, native_ms } of lines.map((line) => JSON.parse(line) as Native)) {
      const request = readFileSync(join(folder, `${robots}.json`), 'utf8');
      expect((JSON.parse(plan(request)) as PlanAnswer).plan?.ok).toBe(true);
      const rounds = Math.min(Math.max(Math.floor(3000 / robots), 3), 41);
      const webassembly_ms = await medianOf(rounds, () => plan(request));
      const row = { robots, native_ms, webassembly_ms, ratio: webassembly_ms / native_ms };
      process.stdout.write(`\n${JSON.stringify(row)}\n`);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});
