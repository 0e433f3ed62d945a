import { readFileSync } from 'node:fs';
import { answering } from '../base/worker.testing';
import { initSync, LightPictures, PlannedLight } from '../generated/browser';
import type { LightWorker } from './asking';
import { createResponder, type LightAsk } from './protocol';

/** A worker with the real module, on this thread; `asked` gets each message. */
export function realLightWorker(asked: (ask: LightAsk) => void = () => undefined): LightWorker {
  initSync({ module: readFileSync(new URL('../generated/browser_bg.wasm', import.meta.url)) });
  const respond = createResponder({ PlannedLight, LightPictures });
  return answering((ask) => {
    asked(ask);
    return respond(ask);
  });
}
