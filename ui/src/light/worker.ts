import load, { LightPictures, PlannedLight } from '../generated/browser';
import address from '../generated/browser_bg.wasm?url';
import { createResponder, type LightAsk, type LightReply } from './protocol';

/** The module, in this worker's own thread, so that light need not wait for other work. */
const loaded = load({ module_or_path: address });
let respond: ((ask: LightAsk) => LightReply) | null = null;
const answer = (message: LightReply) => self.postMessage(message);

self.onmessage = async ({ data }: MessageEvent<LightAsk>) => {
  try {
    await loaded;
    respond ??= createResponder({ PlannedLight, LightPictures });
    answer(respond(data));
  } catch (error) {
    reportError(error);
    answer({ of: 'failure' });
  }
};
