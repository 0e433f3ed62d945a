/** Three layers that move. */
export const LAYERS = [
  { kind: 'rainbow', settings: { speed_hz: 0.2 } },
  { kind: 'chase', settings: { palette: ['#000000', '#ffffff'], blend: 'add' } },
  { kind: 'twinkle', settings: { palette: ['#000000', '#ffffff'], blend: 'add' } },
];

/** Side of the square floor for a number of robots, metres. */
export const sideOf = (count: number) => Math.ceil(Math.sqrt(count)) * 0.12 + 1;

/**
 * A show of two frames of `count` coloured pixels in a grid, the second turned by 0.7 rad. Robots drive most of the
 * time. They start on the first frame, because thousands of them would need minutes to drive to it.
 */
export function crowdShow(count: number, layers: readonly object[]): string {
  const across = Math.ceil(Math.sqrt(count));
  const side_m = sideOf(count);
  const round = (n: number) => Math.round(n * 1e4) / 1e4;
  const frame = (name: string, angle: number) => ({
    name,
    air_time_s: 0.2,
    pixels: Array.from({ length: count }, (_, id) => {
      const [u, v] = [(id % across) - (across - 1) / 2, Math.floor(id / across) - (across - 1) / 2];
      const [x, y] = [u * 0.085, v * 0.085];
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const hue = Math.floor((id * 0x9e3779) % 0xffffff) | 0x404040;
      return {
        id,
        place: [round(c * x - s * y), round(s * x + c * y)],
        color: `#${hue.toString(16).padStart(6, '0')}`,
      };
    }),
  });
  const stage = { width_m: side_m, depth_m: side_m };
  const frames = [frame('One', 0), frame('Two', 0.7)];
  const starts = frames[0]?.pixels.map((pixel) => pixel.place);
  const name = `Crowd of ${count}`;
  return JSON.stringify({ lightbots: 2, name, stage, starts, frames, layers });
}

/** A show in which rows of robots go back and forth; each of `layers` layers spans up to six frames. */
export function longShow(robots: number, frames: number, layers: number): string {
  const one = (_: unknown, nth: number) => ({
    id: `f${nth}`,
    name: `Frame ${nth + 1}`,
    air_time_s: 1 + (nth % 3),
    pixels: Array.from({ length: robots }, (__, id) => ({
      id,
      place: [
        Math.round((-0.55 + (id % 12) * 0.1) * 1e4) / 1e4,
        (nth % 4) * 0.2 + Math.floor(id / 12) * 0.12,
      ],
      color: nth % 2 === 0 ? '#ff8c00' : '#18a0ff',
    })),
  });
  const layer = (_: unknown, nth: number) => {
    const first = Math.floor((nth * frames) / layers);
    return {
      ...LAYERS[nth % LAYERS.length],
      frames: [`f${first}`, `f${Math.min(frames - 1, first + 5)}`],
    };
  };
  return JSON.stringify({
    lightbots: 2,
    name: `${frames} frames`,
    stage: { width_m: 3, depth_m: 3 },
    frames: Array.from({ length: frames }, one),
    layers: Array.from({ length: layers }, layer),
  });
}
