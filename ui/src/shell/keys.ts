/** The keyboard map; the bindings stand beside their commands. */
export const KEYS: { title: string; keys: [string[], string][] }[] = [
  {
    title: 'Everywhere',
    keys: [
      [['Shift', 'Esc'], 'Stop all robots'],
      [['G'], 'Live view or editor'],
      [['Ctrl', 'O'], 'Open a show'],
      [['?'], 'This map'],
    ],
  },
  {
    title: 'Live',
    keys: [
      [['Space'], 'Play, pause, resume'],
      [['S'], 'Step to the next frame'],
      [['P'], 'Drive robots to this frame'],
      [['Esc'], 'Abort'],
      [['L'], 'Loop'],
      [['T', 'W'], 'Planned places, planned ways'],
      [['R'], 'Refresh: who is there?'],
      [['C'], 'Checklist before the start'],
      [['←', '→'], 'Choose a frame'],
    ],
  },
  {
    title: 'Editor: pixels',
    keys: [
      [['Click', 'Shift'], 'Choose; add or take away'],
      [['Ctrl', 'A'], 'Choose all'],
      [['[', ']'], 'Pixel before, next pixel'],
      [['Ctrl', 'I'], 'Invert the choice'],
      [['Arrows'], 'Move 1 cm (Shift 10 cm, Alt 1 mm)'],
      [['Ctrl', 'C / V'], 'Copy, paste into any frame'],
      [['T', 'S'], 'Make words, make a shape'],
      [['V', 'Q', 'I', 'O'], 'Arrow, lasso, eyedropper, no-go areas'],
      [['Esc'], 'Choose none; give up a drag'],
    ],
  },
  {
    title: 'Editor: frames and history',
    keys: [
      [['Page ↑', 'Page ↓'], 'Frame before, frame after'],
      [['Ctrl', 'Enter'], 'New frame'],
      [['Ctrl', 'D'], 'Duplicate frame'],
      [['Ctrl', 'Delete'], 'Delete frame'],
      [['Alt', 'Page ↑ / ↓'], 'Move chosen frames'],
      [['Shift / Ctrl', 'Click'], 'Choose several frames'],
      [['F2'], 'Rename frame'],
      [['Ctrl', 'Z'], 'Undo'],
      [['Ctrl', 'Shift', 'Z'], 'Redo'],
      [['Space'], 'Preview, without robots'],
      [['M', 'N', 'H', 'W'], 'Snap, ids, ghosts, planned ways'],
      [['0', '+', '−'], 'Fit, zoom'],
    ],
  },
];
