/** What somebody dropped or pasted: files, or a text. */
export interface Dropped {
  files: readonly File[];
  text: string;
}

/** What can be dropped, in words. */
export const DROPPABLE =
  'drawings (SVG), pictures (PNG, JPEG, WebP), animations (GIF, WebP), lists (CSV), fonts (TTF, OTF), words and shows';
