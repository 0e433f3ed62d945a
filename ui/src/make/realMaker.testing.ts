import { readFileSync } from 'node:fs';
import { answering } from '../base/worker.testing';
import { beats, film, fit, initSync, list, look, make, moved, plan } from '../generated/browser';
import { createMaker, type Maker } from './maker';
import { reply } from './protocol';

/** A maker with the real module on this thread, behind the protocol of the worker. */
export function realMaker(): Maker {
  initSync({ module: readFileSync(new URL('../generated/browser_bg.wasm', import.meta.url)) });
  return createMaker(() =>
    answering((ask) => reply({ make, film, fit, plan, list, look, beats, moved }, ask)),
  );
}
