import { framesOf, layersOf, setLayer, setLayerFrames, type Layer } from './layers';
import type { Show } from './show';
import type { Block } from './timelineBlocks';
import { LATEST_S } from './timelineMarks';

/** When a layer shines, seconds of show time. */
export interface LayerBar {
  from_s: number;
  to_s: number;
  /** Whether its ends can be moved: not for a layer over the whole show. */
  hasEnds: boolean;
}

/** Shortest layer of seconds, seconds. */
const SHORTEST_S = 0.1;

/** Where a layer begins in its first frame, and ends in its last one. */
const beginOf = (block: Block, { when }: Layer) =>
  when.of === 'frames' && when.phase === 'picture' ? block.shownFrom_s : block.driveFrom_s;
const endOf = (block: Block, { when }: Layer) =>
  when.of === 'frames' && when.phase === 'transition' ? block.shownFrom_s : block.until_s;

/** From the layer's begin in its first frame to its end in the last; null: the show lacks one of these frames. */
export function layerBar(show: Show, blocks: readonly Block[], layer: Layer): LayerBar | null {
  const { when } = layer;
  if (when.of === 'seconds') return { from_s: when.from_s, to_s: when.to_s, hasEnds: true };
  const range = when.of === 'show' ? ([0, blocks.length - 1] as const) : framesOf(show, layer);
  const [begin, end] = range ? [blocks[range[0]], blocks[range[1]]] : [];
  if (!begin || !end) return null;
  return {
    from_s: beginOf(begin, layer),
    to_s: endOf(end, layer),
    hasEnds: when.of === 'frames',
  };
}

/** A part of a layer's bar that is moved: an end, or the whole of it. */
export type LayerPart = 'from' | 'to' | 'whole';

const hundredths = (seconds: number) => Math.round(seconds * 100) / 100;

/**
 * The show with an end of a layer at `to_s` of show time, or with the whole layer beginning at it. A layer of frames
 * goes to the frame with the nearest edge. A layer over the whole show stays.
 */
export function moveLayerPart(
  show: Show,
  blocks: readonly Block[],
  index: number,
  part: LayerPart,
  to_s: number,
): Show {
  const layer = layersOf(show)[index];
  if (!layer) return show;
  const { when } = layer;
  if (when.of === 'seconds') {
    const length_s = when.to_s - when.from_s;
    const at_s = Math.max(0, Math.min(LATEST_S, hundredths(to_s)));
    const begin_s = Math.min(at_s, LATEST_S - length_s);
    const span =
      part === 'from'
        ? { from_s: Math.min(at_s, when.to_s - SHORTEST_S), to_s: when.to_s }
        : part === 'to'
          ? { from_s: when.from_s, to_s: Math.max(at_s, when.from_s + SHORTEST_S) }
          : { from_s: begin_s, to_s: hundredths(begin_s + length_s) };
    if (span.from_s === when.from_s && span.to_s === when.to_s) return show;
    return setLayer(show, index, { when: { of: 'seconds', ...span } });
  }
  const range = framesOf(show, layer);
  if (when.of !== 'frames' || !range) return show;
  const edge = part === 'to' ? endOf : beginOf;
  const next = moved(
    range,
    part,
    nearest(
      blocks.map((block) => edge(block, layer)),
      to_s,
    ),
    blocks.length,
  );
  if (next[0] === range[0] && next[1] === range[1]) return show;
  return setLayerFrames(show, index, next, when.phase);
}

/** Moves an end of a layer, or the whole of it: by `by_s` seconds, or for a layer of frames by one frame that way. */
export function stepLayerPart(
  show: Show,
  blocks: readonly Block[],
  index: number,
  part: LayerPart,
  by_s: number,
): Show {
  const layer = layersOf(show)[index];
  const bar = layer && layerBar(show, blocks, layer);
  if (!layer || !bar) return show;
  const { when } = layer;
  if (when.of !== 'frames')
    return moveLayerPart(show, blocks, index, part, (part === 'to' ? bar.to_s : bar.from_s) + by_s);
  const range = framesOf(show, layer);
  if (!range) return show;
  const frame = (part === 'to' ? range[1] : range[0]) + Math.sign(by_s);
  if (frame < 0 || frame >= blocks.length) return show;
  return setLayerFrames(show, index, moved(range, part, frame, blocks.length), when.phase);
}

/** First and last frame of a layer after `part` went to `frame`; the whole layer stays within `count` frames. */
function moved(
  [first, last]: readonly [number, number],
  part: LayerPart,
  frame: number,
  count: number,
): readonly [number, number] {
  if (part === 'from') return [Math.min(frame, last), last];
  if (part === 'to') return [first, Math.max(first, frame)];
  const begin = Math.min(frame, count - 1 - (last - first));
  return [begin, begin + last - first];
}

const nearest = (moments: readonly number[], to_s: number) =>
  moments.reduce(
    (best, at_s, i) => (Math.abs(at_s - to_s) < Math.abs((moments[best] ?? 0) - to_s) ? i : best),
    0,
  );
