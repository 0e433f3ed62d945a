import { canvasFromStage, type Camera } from '../stage/camera';
import { FLOOR } from '../stage/palette';
import { gripsOf } from './pictureHand';
import type { Picture } from '../make/picture';

/** Draws the box of the picture that is made, its handles and the knob that turns it. */
export function paintPicture(
  c: CanvasRenderingContext2D,
  camera: Camera,
  picture: Picture,
  stretches: boolean,
) {
  const grips = gripsOf(picture, camera, stretches).map(({ grip, at }) => ({
    grip,
    at: canvasFromStage(camera, at),
  }));
  const [knob] = grips;
  const corners = grips.filter(({ grip }) => grip.kind === 'scale');
  const [left, right] = corners;
  if (!knob || !left || !right) return;
  c.strokeStyle = FLOOR.box;
  c.lineWidth = 1;
  c.beginPath();
  for (const { at } of corners) c.lineTo(at.x, at.y);
  c.closePath();
  c.moveTo((left.at.x + right.at.x) / 2, (left.at.y + right.at.y) / 2);
  c.lineTo(knob.at.x, knob.at.y);
  c.stroke();
  for (const { grip, at } of grips) {
    c.beginPath();
    if (grip.kind === 'turn') c.arc(at.x, at.y, 5.5, 0, 2 * Math.PI);
    else paintSquare(c, at, picture.turn);
    c.fillStyle = FLOOR.plate;
    c.fill();
    c.strokeStyle = FLOOR.chosen;
    c.lineWidth = 1.5;
    c.stroke();
  }
}

/** A square handle that is turned with the picture. */
function paintSquare(c: CanvasRenderingContext2D, at: { x: number; y: number }, turn: number) {
  const [cos, sin] = [4 * Math.cos(turn), 4 * Math.sin(turn)];
  for (const [u, v] of [
    [-1, 1],
    [1, 1],
    [1, -1],
    [-1, -1],
  ] as const)
    c.lineTo(at.x + u * cos - v * sin, at.y - u * sin - v * cos);
  c.closePath();
}
