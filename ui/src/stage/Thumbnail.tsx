import { memo, useEffect, useRef } from 'react';
import type { Frame, Stage } from '../model/show';
import { fit } from './camera';
import { createRasteriser, RASTERISED_MIN } from './rasteriser';
import { createSprites } from './sprites';
import { FLOOR } from './palette';

const sprites = createSprites();
const rasteriser = createRasteriser();
/** Side of a thumbnail, device pixels: twice what it is shown at. */
const SIDE = 176;

/** A small picture of a frame. */
export const Thumbnail = memo(function Thumbnail({ frame, stage }: { frame: Frame; stage: Stage }) {
  const element = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const canvas = element.current;
    const context = canvas?.getContext('2d');
    if (canvas && context) paint(context, frame, stage);
  }, [frame.pixels, stage, frame]);
  return <canvas ref={element} width={SIDE} height={SIDE} aria-hidden />;
});

function paint(context: CanvasRenderingContext2D, frame: Frame, stage: Stage) {
  const camera = fit(stage.width_m, stage.depth_m, { width_px: SIDE, height_px: SIDE }, 5);
  context.globalCompositeOperation = 'source-over';
  context.globalAlpha = 1;
  context.fillStyle = FLOOR.plate;
  context.fillRect(0, 0, SIDE, SIDE);
  const radius = Math.max(1.5, stage.radius_m * 1.25 * camera.scale);
  if (frame.pixels.length >= RASTERISED_MIN) {
    const picture = context.getImageData(0, 0, SIDE, SIDE);
    const dots = frame.pixels.map((pixel) => ({ ...pixel, alpha: 1 }));
    rasteriser.addLights(picture, dots, radius, camera, 1);
    context.putImageData(picture, 0, 0);
    return;
  }
  context.fillStyle = FLOOR.edge;
  for (const pixel of frame.pixels) {
    const [x, y] = [SIDE / 2 + pixel.x * camera.scale, SIDE / 2 - pixel.y * camera.scale];
    const glow = sprites.glow(pixel.color, radius);
    context.globalCompositeOperation = glow ? 'lighter' : 'source-over';
    if (glow) context.drawImage(glow, x - glow.width / 2, y - glow.height / 2);
    else context.fillRect(x - radius / 2, y - radius / 2, radius, radius);
  }
}
