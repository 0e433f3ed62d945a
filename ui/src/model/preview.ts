import { createStore, type Readable } from '../base/store';
import type { Editor } from './editor';
import { segmentAt, totalOf, previewFrom, type Segment } from './timeline';

/** The planned show, played on the editor's stage without robots. */
export interface Preview {
  /** The moment on the stage, seconds from the start of the first drive; null: the frame as it is drawn. */
  time_s: Readable<number | null>;
  running: Readable<boolean>;
  /** Pauses if the preview runs, else lets it run on. */
  toggle(): void;
  /** Back to the frame as it is drawn. */
  stop(): void;
  /** Pauses at this moment, seconds as in `time_s`. */
  scrub(timeline: readonly Segment[], time_s: number): void;
  /** Puts the moment that the preview begins with on the stage. */
  begin(timeline: readonly Segment[]): void;
  /** Goes on by this many seconds; at the end of the show the preview stops. */
  advance(timeline: readonly Segment[], by_s: number): void;
}

export function createPreview(editor: Editor): Preview {
  const time_s = createStore<number | null>(null);
  const running = createStore(false);
  const frame = () => editor.state.get().frame;
  const stop = () => {
    running.set(false);
    time_s.set(null);
  };
  /** The frame on the stage follows the moment, so that it is the one that is edited after the preview. */
  const showAt = (timeline: readonly Segment[], at_s: number) => {
    time_s.set(Math.min(at_s, totalOf(timeline)));
    const segment = segmentAt(timeline, at_s);
    if (segment && segment.frame !== frame()) editor.goToFrame(segment.frame);
  };
  return {
    time_s,
    running,
    toggle: () => running.update((on) => !on),
    stop,
    scrub(timeline, at_s) {
      running.set(false);
      showAt(timeline, at_s);
    },
    begin: (timeline) => showAt(timeline, previewFrom(timeline, frame(), time_s.get())),
    advance(timeline, by_s) {
      const next = (time_s.get() ?? 0) + by_s;
      showAt(timeline, next);
      if (next >= totalOf(timeline)) stop();
    },
  };
}
