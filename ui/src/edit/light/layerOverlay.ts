import { layerGrips } from '../../model/layerTool';
import type { Layer } from '../../model/layers';
import { canvasFromStage, type Camera } from '../../stage/camera';
import { beginHandles, dashedLine, DOT_PX, roundHandle } from '../handlePaint';

/** Draws the handles of a layer: a circle at its place, and a dashed line to a square at the end of its span. */
export function paintLayer(c: CanvasRenderingContext2D, camera: Camera, layer: Layer) {
  const [place, end] = layerGrips(layer).map(({ at }) => canvasFromStage(camera, at));
  if (!place) return;
  beginHandles(c);
  if (end) {
    dashedLine(c, [place, end]);
    c.beginPath();
    c.rect(end.x - DOT_PX + 1, end.y - DOT_PX + 1, 2 * DOT_PX - 2, 2 * DOT_PX - 2);
    c.fill();
    c.stroke();
  }
  roundHandle(c, place);
}
