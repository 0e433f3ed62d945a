import { messageOf } from '../base/errors';
import { createAudioOut, type AudioOut } from './audioOut';
import { createPlayer, type Player } from './player';

/** Plays one file of music at a time on this screen. */
export interface Sounding {
  /** Gets a file ready to be heard, in place of another. Call it in a press of the user. Throws a text for people. */
  open(hash: string): Promise<void>;
  /** As `Player.follow`; silent while nothing is open. */
  follow(position_s: number | null, now_ms: number): void;
  close(): void;
}

export function createSounding(
  fileOf: (hash: string) => Promise<Uint8Array<ArrayBuffer>>,
  audioOut: typeof createAudioOut = createAudioOut,
): Sounding {
  let opened: { hash: string; out: AudioOut; player: Player } | null = null;
  let opening: Promise<void> | null = null;
  let closings = 0;
  const end = () => {
    opened?.player.stop();
    opened?.out.close();
    opened = null;
  };
  const load = async (hash: string, before: number) => {
    const out = await fileOf(hash)
      .then(audioOut)
      .catch((error: unknown) => {
        throw new Error(`The music cannot be heard: ${messageOf(error)}`);
      });
    if (closings !== before) {
      out.close();
      return;
    }
    end();
    opened = { hash, out, player: createPlayer(out, out.lasts_s) };
  };
  return {
    async open(hash) {
      if (opened?.hash === hash) return;
      const before = closings;
      await opening?.catch(() => undefined);
      if (opened?.hash === hash || closings !== before) return;
      opening = load(hash, before);
      await opening;
    },
    follow: (position_s, now_ms) => opened?.player.follow(position_s, now_ms),
    close() {
      closings += 1;
      end();
    },
  };
}
