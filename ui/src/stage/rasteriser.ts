import type { Dot } from '../base/geometry';
import { blue, green, luma, red } from '../base/colour';
import type { Camera } from './camera';
import { CORE_ALPHA, CORE_RADII, GLOW_RADII, glowAlpha } from './glow';
import { createStamps, type Ink, type Pixels, type Round, type Stamps } from './stamps';

/** From this number of lights on, they are rasterised in software, because sprites of many colours cost more. */
export const RASTERISED_MIN = 400;

/** Width of a ring's line as a share of its radius, before it is limited to one to two CSS pixels. */
const LINE_RADII = 0.16;

/** Paints one shape at every dot. */
type Painter = (
  pixels: Pixels,
  dots: readonly Dot[],
  radius_px: number,
  camera: Camera,
  density: number,
) => void;

/**
 * Paints lights, bodies of dark robots, and rings into an array of pixels. With a thousand fading colours this is
 * faster than one sprite per colour, and as fast without a graphics card as with one.
 */
export interface Rasteriser {
  addLights: Painter;
  layBodies: Painter;
  layRings: Painter;
}

export function createRasteriser(): Rasteriser {
  return {
    addLights: painter((radius_px) => createStamps(lightOf(radius_px), lightInk)),
    layBodies: painter((radius_px) => createStamps(bodyOf(radius_px), bodyInk)),
    layRings: painter((radius_px, density) => {
      const line_px = Math.max(density, Math.min(2 * density, radius_px * LINE_RADII));
      return createStamps(ringOf(radius_px, line_px), ringInk);
    }),
  };
}

function painter(make: (radius_px: number, density: number) => Stamps): Painter {
  const stamps = remembered(make);
  return (pixels, dots, radius_px, camera, density) =>
    stamps(radius_px, density).press(pixels, dots, camera, density);
}

/** `make` with a memory of one: the same radius and density as in the last call give the same result. */
function remembered<T>(make: (radius_px: number, density: number) => T) {
  let last: { radius_px: number; density: number; made: T } | null = null;
  return (radius_px: number, density: number): T => {
    if (last?.radius_px !== radius_px || last.density !== density)
      last = { radius_px, density, made: make(radius_px, density) };
    return last.made;
  };
}

const lightOf = (radius_px: number): Round => ({
  reach_px: radius_px * GLOW_RADII,
  bodyAt: (away_px) => glowAlpha(away_px / radius_px),
  shineAt: (away_px) => CORE_ALPHA * Math.max(0, 1 - away_px / radius_px / CORE_RADII),
});

function lightInk({ color, alpha }: Dot, ink: Ink) {
  ink.r = red(color) * alpha;
  ink.g = green(color) * alpha;
  ink.b = blue(color) * alpha;
  ink.white = 255 * Math.min(1, 0.25 + luma(color)) * alpha;
}

/** A disc with a brighter rim; edges are soft. */
const bodyOf = (radius_px: number): Round => {
  const rim_px = Math.max(1, radius_px * 0.12);
  const cover = (away_px: number, at_px: number) => Math.max(0, Math.min(1, at_px + 0.5 - away_px));
  return {
    reach_px: radius_px + 1,
    bodyAt: (away_px) => cover(away_px, radius_px),
    shineAt: (away_px) => cover(away_px, radius_px) - cover(away_px, radius_px - rim_px),
  };
};

function bodyInk({ alpha }: Dot, ink: Ink) {
  ink.covers = 0.35 + 0.65 * alpha;
  ink.r = red(BODY) * ink.covers;
  ink.g = green(BODY) * ink.covers;
  ink.b = blue(BODY) * ink.covers;
  ink.white = RIM * ink.covers;
}

/** Colour of a robot without light. */
const BODY = 0x1b2029;
/** Brightness that the rim of a robot adds to each component, 0 to 255. */
const RIM = 70;

/** A ring: a circle of radius `radius_px`, as a line `line_px` thick with soft edges, pixels. */
const ringOf = (radius_px: number, line_px: number): Round => ({
  reach_px: radius_px + line_px / 2 + 1,
  bodyAt: (away_px) => Math.max(0, Math.min(1, line_px / 2 + 0.5 - Math.abs(away_px - radius_px))),
  shineAt: () => 0,
});

function ringInk(dot: Dot, ink: Ink) {
  ink.covers = RING_ALPHA * dot.alpha;
  const color = dot.color === 0 ? OFF : dot.color;
  ink.r = red(color) * ink.covers;
  ink.g = green(color) * ink.covers;
  ink.b = blue(color) * ink.covers;
}

/** Opacity of a ring at full alpha of its dot, 0 to 1. */
const RING_ALPHA = 0.7;
/** Colour of a ring for a pixel without light. */
const OFF = 0x7d889c;
