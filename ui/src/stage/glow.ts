/** Radius of a light's glow in radii of the robot. */
export const GLOW_RADII = 3.4;

/** Share of the colour, 0 to 1, by distance from the middle in robot radii: bright to the rim, then a soft falloff. */
export const GLOW_STOPS: readonly (readonly [radii: number, alpha: number])[] = [
  [0, 1],
  [0.78, 0.92],
  [1, 0.42],
  [1.5, 0.2],
  [2.3, 0.06],
  [GLOW_RADII, 0],
];

/** Radius of the white core of a light, in radii of the robot. */
export const CORE_RADII = 0.7;
/** Strength of the white core in its middle, 0 to 1. */
export const CORE_ALPHA = 0.55;

/** Share of the colour, 0 to 1, at a distance from the middle in radii: `GLOW_STOPS` with straight lines between. */
export function glowAlpha(radii: number): number {
  let [fromRadii, from] = [0, 1];
  for (const [toRadii, to] of GLOW_STOPS) {
    if (radii <= toRadii && toRadii > fromRadii)
      return from + ((to - from) * (radii - fromRadii)) / (toRadii - fromRadii);
    [fromRadii, from] = [toRadii, to];
  }
  return 0;
}
