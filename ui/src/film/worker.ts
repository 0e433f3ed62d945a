import load, { FilmPainter, LightPictures, PlannedLight } from '../generated/browser';
import address from '../generated/browser_bg.wasm?url';
import type { LightAnswer } from '../api/types.gen';
import { messageOf } from '../base/errors';
import { createEncoder } from './encode';
import type { FilmAsk, FilmReply } from './protocol';

/** Least time between two messages that say how far the film is, milliseconds. */
const TOLD_EVERY_MS = 100;

const say = (reply: FilmReply, transfer: Transferable[] = []) =>
  self.postMessage(reply, { transfer });

self.onmessage = async ({ data }: MessageEvent<FilmAsk>) => {
  try {
    await load({ module_or_path: address });
    const bytes = await make(data);
    say({ of: 'film', bytes }, [bytes]);
  } catch (error) {
    say({ of: 'failure', message: messageOf(error) });
  }
};

async function make({ request, pictures, settings, music }: FilmAsk): Promise<ArrayBuffer> {
  const decoded = new LightPictures();
  for (const { hash, bytes } of pictures) decoded.add(hash, bytes);
  const light = new PlannedLight(JSON.stringify(request), decoded);
  const { error } = JSON.parse(light.answer()) as LightAnswer;
  if (error) throw new Error(error.message);
  const { width, height, fps, fromFront } = settings;
  const painter = new FilmPainter(light, fromFront, width, height, fps);
  const count = painter.pictures();
  const encoder = await createEncoder(settings, music, painter.music_begins_s(), count / fps);
  let told_ms = 0;
  for (let picture = 0; picture < count; picture += 1) {
    await encoder.add(painter.picture(light, picture), picture);
    const now_ms = performance.now();
    if (now_ms - told_ms < TOLD_EVERY_MS) continue;
    told_ms = now_ms;
    say({ of: 'painted', picture, pictures: count });
  }
  return encoder.finish();
}
