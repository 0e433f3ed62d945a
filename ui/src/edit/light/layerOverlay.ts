import { layerGrips } from '../../model/layerTool';
import type { Layer } from '../../model/layers';
import { canvasFromStage, type Camera } from '../../stage/camera';
import { FLOOR } from '../../stage/palette';

const DOT_PX = 6;

/** Draws the handles of a layer: where it starts, and the line to the end of its span. */
export function paintLayer(c: CanvasRenderingContext2D, camera: Camera, layer: Layer) {
  const [place, end] = layerGrips(layer).map(({ at }) => canvasFromStage(camera, at));
  if (!place) return;
  c.strokeStyle = FLOOR.chosen;
  c.fillStyle = FLOOR.plate;
  c.lineWidth = 1.5;
  if (end) {
    c.setLineDash([5, 4]);
    c.beginPath();
    c.moveTo(place.x, place.y);
    c.lineTo(end.x, end.y);
    c.stroke();
    c.setLineDash([]);
    c.beginPath();
    c.rect(end.x - DOT_PX + 1, end.y - DOT_PX + 1, 2 * DOT_PX - 2, 2 * DOT_PX - 2);
    c.fill();
    c.stroke();
  }
  c.beginPath();
  c.arc(place.x, place.y, DOT_PX, 0, 2 * Math.PI);
  c.fill();
  c.stroke();
}
