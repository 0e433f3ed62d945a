/** What pixels of a frame were made from: a word, a drawing, a picture. */
export interface FrameSource {
  kind: SourceKind;
  /** Hash of the file behind it; null: the settings say everything. */
  asset: string | null;
  /** Seed of all random choices in placing its pixels. */
  seed: number;
  /** Where its picture lies on the floor; null: the whole floor. */
  box: FloorBox | null;
  /** Ids of pixels that were moved by hand: they keep their place when the others are placed anew. */
  moved: readonly number[];
  /** A word that frames share which were made together; null: made alone. */
  series: string | null;
  /** The moment of an animation that the frame shows, seconds; null: no animation. */
  moment_s: number | null;
  /** Values that belong to the kind. */
  settings: Readonly<Record<string, unknown>>;
}

export const SOURCE_KINDS = ['text', 'svg', 'picture', 'shape', 'list', 'animation'] as const;
export type SourceKind = (typeof SOURCE_KINDS)[number];

/** A rectangle on the floor, stage metres. */
export interface FloorBox {
  min: readonly [number, number];
  max: readonly [number, number];
}

/** The part of a source that a pixel belongs to. */
export interface SourcePart {
  /** Index in the sources of the frame, counted from 0. */
  source: number;
  /** Name of the part, such as a letter of a word; may be empty. */
  name: string;
}
