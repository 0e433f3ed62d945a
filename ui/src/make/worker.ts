import load, { beats, film, fit, list, look, make, moved, plan } from '../generated/browser';
import address from '../generated/browser_bg.wasm?url';
import { reply, type Ask, type Reply } from './protocol';

/** The module, in this worker's own thread, so that the page stays quick while frames are made. */
const loaded = load({ module_or_path: address });
const answer = (message: Reply) => self.postMessage(message);

self.onmessage = async ({ data }: MessageEvent<Ask>) => {
  try {
    await loaded;
  } catch (error) {
    reportError(error);
    answer({ of: 'failure', cause: 'unloaded' });
    return;
  }
  try {
    answer(reply({ make, film, fit, plan, list, look, beats, moved }, data));
  } catch (error) {
    reportError(error);
    answer({ of: 'failure', cause: 'broken' });
  }
};
