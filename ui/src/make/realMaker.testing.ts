import { readFileSync } from 'node:fs';
import { film, fit, initSync, list, look, make, plan } from '../generated/browser';
import { createMaker, type Maker, type WorkerLike } from './maker';
import { reply } from './protocol';

/** The real module on this thread, behind the same protocol as in a worker. */
export function realMaker(): Maker {
  initSync({ module: readFileSync(new URL('../generated/browser_bg.wasm', import.meta.url)) });
  return createMaker(() => {
    const worker: WorkerLike = {
      onmessage: null,
      onerror: null,
      postMessage: (ask) =>
        void Promise.resolve().then(() =>
          worker.onmessage?.({
            data: reply({ make, film, fit, plan, list, look }, ask),
          } as MessageEvent),
        ),
      terminate: () => undefined,
    };
    return worker;
  });
}
