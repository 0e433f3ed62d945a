/** Colours of the floor for canvases, which cannot read style sheets; the same as `--floor…` in style/tokens.css. */
export const FLOOR = {
  floor: '#06070a',
  plate: '#0b0d12',
  grid: '#171b23',
  axis: '#21262e',
  edge: '#475063',
  ink: '#e6eaf1',
  ink2: '#a8b3c5',
  body: '#1b2029',
  rim: '#59637a',
  care: '#ff9b69',
  chosen: '#ffffff',
  box: 'rgb(255 255 255 / 0.5)',
  guide: '#86c9ff',
  guideWash: 'rgb(134 201 255 / 0.1)',
  obstacle: 'rgb(120 134 160 / 0.16)',
  pin: '#f2b95c',
} as const;
