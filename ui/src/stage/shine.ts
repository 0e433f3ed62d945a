/** Radius of a light with its glow, in radii of the robot. */
export const LIGHT_RADII = 3.6;

/**
 * How brightly a light shines at a distance from its middle, in radii of the robot, for an audience in a dark hall.
 * `glow` is in the light's colour, `core` in white, both 0 to 1.
 */
export function shineAt(radii: number): { glow: number; core: number } {
  if (radii >= LIGHT_RADII) return { glow: 0, core: 0 };
  const bell = (width: number) => Math.exp(-((radii / width) ** 2));
  // Down to nothing at `LIGHT_RADII`, so that no edge is seen.
  const rim = Math.min(1, 2 * (1 - radii / LIGHT_RADII));
  return { glow: (0.8 * bell(0.8) + 0.16 * bell(1.7)) * rim, core: 0.4 * bell(0.45) };
}
