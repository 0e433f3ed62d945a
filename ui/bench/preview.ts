import { test } from 'vitest';
import type { MakeQuality } from '../src/api/types.gen';
import { newDraft, sourcesOf } from '../src/make/draft';
import { requestOf } from '../src/make/frame';
import { realMaker } from '../src/make/realMaker.testing';
import { newShow } from '../src/model/show';
import { medianOf } from './median';

/** The cat of the contact sheet: an area and a line. */
const CAT = new URL('../../crates/make/examples/sheet/drawings/cat.svg', import.meta.url);

/** Previews while the size changes as by a slider. */
const ROUNDS = 5;

test('frames by the WebAssembly module, as in the browser', async () => {
  const { readFileSync } = await import('node:fs');
  const maker = realMaker();
  const words = { ...newDraft('text'), text: 'HELLO' };
  const drawing = {
    ...newDraft('file'),
    files: [{ hash: 'cat', name: 'cat.svg', kind: 'svg' } as const],
  };
  for (const [name, draft, asset] of [
    ['HELLO', words, null],
    ['cat', drawing, readFileSync(CAT)],
  ] as const)
    for (const robots of [30, 100, 1000]) {
      const side_m = Math.sqrt(robots) * 0.4 + 1;
      const empty = newShow('x', 1);
      const show = { ...empty, stage: { ...empty.stage, width_m: side_m, depth_m: side_m } };
      const make = (quality: MakeQuality) => (step: number) => {
        const [source] = sourcesOf({ ...draft, size_m: side_m * (0.7 + 0.01 * step) });
        const [frame] = show.frames;
        if (!source || !frame) throw new Error('There is nothing to make.');
        return maker.make(requestOf(show, frame, source, robots, quality), asset);
      };
      const row = {
        source: name,
        robots,
        preview_ms: await medianOf(ROUNDS, make('quick')),
        full_ms: await medianOf(ROUNDS, make('full')),
      };
      process.stdout.write(`\n${JSON.stringify(row)}\n`);
    }
});
