/** A frame as the original's editor saves it. */
export interface OriginalFrame {
  name: string;
  airTime: number;
  selected: boolean;
  selectedPixels: unknown[];
  pixels: OriginalPixel[];
}

interface Place {
  X: number;
  Y: number;
}

export interface OriginalPixel {
  pixelId: number;
  color: { R: number; G: number; B: number };
  previewColor: { R: number; G: number; B: number };
  physicalLocation: Place;
  pixelLocation: Place;
  pixelPreviewLocation: Place;
  pixelTimelineLocation: Place;
}

/** Number of frames of the show. */
const FRAMES = 12;
/** Number of robots of the show, and so of pixels in each frame. */
const ROBOTS = 30;

/** A show in the original's format: turned, growing rings of pixels, not sorted by id, as the original writes them. */
export function originalShow(): OriginalFrame[] {
  return Array.from({ length: FRAMES }, (_, index) => ({
    name: index === 0 ? 'Initial' : `Ring ${index}`,
    airTime: index / 10,
    selected: index === 3,
    selectedPixels: [],
    pixels: Array.from({ length: ROBOTS }, (_, k) => pixel((k * 7) % ROBOTS, index)),
  }));
}

function pixel(pixelId: number, frame: number): OriginalPixel {
  const angle = (2 * Math.PI * (pixelId + frame * 1.3)) / ROBOTS;
  const radius_m = 0.75 + 0.03 * frame;
  // Adding 0 turns −0 into 0: files have no −0.
  const round = (n: number, k: number) => Math.round(n * k) / k + 0;
  const at = {
    X: round(radius_m * Math.cos(angle), 1e4),
    Y: round(radius_m * Math.sin(angle), 1e4),
  };
  const canvas = { X: round(at.X * 240 + 360, 1e3), Y: round(360 - at.Y * 240, 1e3) };
  const share = (n: number) => Math.fround((n % 256) / 255);
  const color = {
    R: share(pixelId * 8 + 5),
    G: share(frame * 20 + 30),
    B: share(255 - pixelId * 5),
  };
  return {
    pixelId,
    color,
    previewColor: color,
    physicalLocation: at,
    pixelLocation: canvas,
    pixelPreviewLocation: canvas,
    pixelTimelineLocation: { X: round(canvas.X / 7.2, 1e4), Y: round(canvas.Y / 7.2, 1e4) },
  };
}
