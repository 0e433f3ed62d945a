/** What the pen does with a line that is drawn on the floor. */
export interface Pen {
  /** Whether each press adds a point at the end. */
  isAdding: boolean;
  /** Index of the chosen point; null: none. */
  point: number | null;
}

export const IDLE_PEN: Pen = { isAdding: false, point: null };
