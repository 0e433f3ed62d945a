import type { ShapeNumber } from './draft';

/** The numeric settings that each shape uses; a shape that is not listed uses none. */
export const SHAPE_NUMBERS: Readonly<Record<string, readonly ShapeNumber[]>> = {
  heart: ['aspect'],
  star: ['count', 'inner'],
  circle: ['aspect'],
  rings: ['count', 'inner'],
  rectangle: ['aspect'],
  polygon: ['count', 'aspect'],
  arrow: ['aspect'],
  wave: ['turns', 'aspect'],
  arc: ['span'],
  spiral: ['turns', 'inner'],
  grid: ['aspect'],
  hexagons: ['aspect'],
  random: ['aspect'],
};

/** Least and greatest ratio of width to height that the Make panel sets. */
export const ASPECT = { min: 0.2, max: 5 } as const;
