import type { ShapeNumber } from './draft';

/** The settings that each shape uses. */
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

/** Least and greatest width to height. */
export const ASPECT = { min: 0.2, max: 5 } as const;
