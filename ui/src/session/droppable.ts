/** What was dropped or pasted: files, or a text. */
export interface Dropped {
  files: readonly File[];
  text: string;
  /** Name of the show that it is for, which may not be open yet; null: the show in the editor. */
  into: string | null;
}

/** What can be dropped, in words. */
export const DROPPABLE =
  'drawings (SVG), pictures (PNG, JPEG, WebP), animations (GIF, WebP), lists (CSV), fonts (TTF, OTF), music (MP3, OGG, WAV, FLAC, M4A), words and shows';
