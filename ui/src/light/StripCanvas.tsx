import { useEffect, useRef, useState } from 'react';
import type { Layer } from '../model/layers';
import type { Stage } from '../model/show';
import { FLOOR } from '../stage/palette';
import type { Lights } from './lights';
import { STRIP_COLUMNS, STRIP_MOMENTS, STRIP_ROBOTS, STRIP_ROWS, type Strip } from './strip';
import styles from './presets.module.css';

/** Side of a robot's cell, device pixels. */
const CELL = 12;
const [WIDTH, HEIGHT] = [STRIP_COLUMNS * CELL, STRIP_ROWS * CELL];
/** Index of the moment that is drawn on screens set to less motion: most effects show in it. */
const STILL = 26;

interface Props {
  lights: Lights;
  layer: Layer;
  stage: Stage;
}

/** What a layer does, on a small floor full of robots, over and over. */
export function StripCanvas({ lights, layer, stage }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [strip, setStrip] = useState<Strip | null>(null);
  useEffect(() => {
    let isWanted = true;
    void lights.strip(layer, stage).then((made) => {
      if (isWanted && made) setStrip(made);
    });
    return () => void (isWanted = false);
  }, [lights, layer, stage]);
  useEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (!context) return;
    context.fillStyle = FLOOR.floor;
    context.fillRect(0, 0, WIDTH, HEIGHT);
    return strip ? play(context, strip) : undefined;
  }, [strip]);
  return <canvas className={styles.strip} ref={canvas} width={WIDTH} height={HEIGHT} aria-hidden />;
}

/** Draws the moments of a strip one after the other, over and over; returns a function that ends this. */
function play(context: CanvasRenderingContext2D, strip: Strip): () => void {
  if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
    paint(context, strip, STILL);
    return () => undefined;
  }
  let [request, shown] = [0, -1];
  const draw = (now_ms: number) => {
    request = requestAnimationFrame(draw);
    const moment = Math.floor(now_ms / 1000 / STRIP_MOMENTS.step_s) % STRIP_MOMENTS.count;
    if (moment !== shown) paint(context, strip, moment);
    shown = moment;
  };
  request = requestAnimationFrame(draw);
  return () => cancelAnimationFrame(request);
}

function paint(context: CanvasRenderingContext2D, strip: Strip, moment: number) {
  context.fillStyle = FLOOR.floor;
  context.fillRect(0, 0, WIDTH, HEIGHT);
  for (let robot = 0; robot < STRIP_ROBOTS; robot++) {
    const at = 3 * (moment * STRIP_ROBOTS + robot);
    context.fillStyle = `rgb(${strip[at]} ${strip[at + 1]} ${strip[at + 2]})`;
    const [x, y] = [(robot % STRIP_COLUMNS) * CELL, Math.floor(robot / STRIP_COLUMNS) * CELL];
    context.beginPath();
    context.arc(x + CELL / 2, y + CELL / 2, CELL * 0.4, 0, 2 * Math.PI);
    context.fill();
  }
}
