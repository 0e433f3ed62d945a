import { layersOf } from './layers';
import type { Show } from './show';
import type { Block } from './timelineBlocks';
import { markersOf, sectionsOf } from './timelineMarks';

/** What is dragged on the timeline: nothing snaps to itself, nor to what moves with it. */
export type Dragged =
  { what: 'block'; index: number } | { what: 'marker' | 'section' | 'layer'; index: number };

/** Moments that a drag snaps to: edges of blocks, marks and layers of seconds, and `more`, such as beats. Show time. */
export function snapMoments(
  show: Show,
  blocks: readonly Block[],
  dragged: Dragged,
  more: readonly number[],
): number[] {
  const isOther = (what: Dragged['what']) => (_: unknown, index: number) =>
    dragged.what !== what || dragged.index !== index;
  // The dragged block and the blocks after it move with the edge.
  const standing = dragged.what === 'block' ? blocks.slice(0, dragged.index) : blocks;
  return [
    ...standing.flatMap((block) => [block.shownFrom_s, block.until_s]),
    ...markersOf(show)
      .filter(isOther('marker'))
      .map(({ at_s }) => at_s),
    ...sectionsOf(show)
      .filter(isOther('section'))
      .flatMap(({ from_s, to_s }) => [from_s, to_s]),
    ...layersOf(show)
      .filter(isOther('layer'))
      .flatMap(({ when }) => (when.of === 'seconds' ? [when.from_s, when.to_s] : [])),
    ...more,
  ];
}
