import type { SoundOut } from './player';

/** A sound device of the browser with music in it. It needs a press of the user before it can be heard. */
export interface AudioOut extends SoundOut {
  lasts_s: number;
  close(): void;
}

/** Decodes a file of music and opens a sound device for it. Rejects if the browser cannot decode the file. */
export async function createAudioOut(bytes: Uint8Array<ArrayBuffer>): Promise<AudioOut> {
  const context = new AudioContext({ latencyHint: 'interactive' });
  const buffer = await context.decodeAudioData(bytes.slice().buffer).catch((error: unknown) => {
    void context.close();
    throw error;
  });
  await context.resume();
  return {
    lasts_s: buffer.duration,
    made_s: () => context.currentTime,
    heard_s(now_ms) {
      const { contextTime, performanceTime } = context.getOutputTimestamp();
      // Both are 0 or missing until the device runs.
      if (!contextTime || !performanceTime) return null;
      return contextTime + (now_ms - performanceTime) / 1000;
    },
    start(at_s, from_s) {
      const node = context.createBufferSource();
      node.buffer = buffer;
      node.connect(context.destination);
      node.start(at_s, from_s);
      return {
        setRate: (rate) => void (node.playbackRate.value = rate),
        stop() {
          node.stop();
          node.disconnect();
        },
      };
    },
    close: () => void context.close(),
  };
}
