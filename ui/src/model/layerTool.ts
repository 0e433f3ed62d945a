import type { Point } from '../base/geometry';
import { isUsed, numberOf, placeOf } from './layerKinds';
import { layersOf, setLayerSettings, type Layer, type LayerSettings } from './layers';
import { NO_OVERLAY } from './editorState';
import type { Tool, Touch } from './tool';

/** What of a layer is dragged: its place, or the end of its span, which also gives its direction. */
export type LayerGrip = 'place' | 'end';

/** The handles of a layer, stage metres: first the place, then the end if there is one; none without a place. */
export function layerGrips(layer: Layer): { grip: LayerGrip; at: Point }[] {
  if (!isUsed(layer, 'place')) return [];
  const place = placeOf(layer);
  const start = { grip: 'place', at: place } as const;
  if (!hasEnd(layer)) return [start];
  const [size_m, angle] = [reach_m(layer), turns(layer) ? numberOf(layer, 'angle') : 0];
  const end = { x: place.x + size_m * Math.cos(angle), y: place.y + size_m * Math.sin(angle) };
  return [start, { grip: 'end', at: end }];
}

/** Whether a span or a direction can be dragged. */
const hasEnd = (layer: Layer) => isUsed(layer, 'size_m') || isUsed(layer, 'angle');
const turns = (layer: Layer) => isUsed(layer, 'angle');
/** Distance of the end's handle from the place, metres: the span, or 0.5 where only the direction counts. */
const reach_m = (layer: Layer) => (isUsed(layer, 'size_m') ? numberOf(layer, 'size_m') : 0.5);

/** The handle under a pointer; of two, the end, which may lie on the place. Null: none. */
export function layerGripAt(layer: Layer, { at, reach_m }: Touch): LayerGrip | null {
  const near = layerGrips(layer).filter(
    (handle) => Math.hypot(handle.at.x - at.x, handle.at.y - at.y) <= reach_m,
  );
  return near[near.length - 1]?.grip ?? null;
}

/** Step of the direction while Shift is held, radians: 15°. */
const TURN_STEP = Math.PI / 12;
/** Least span, metres, as docs/light.md has it. */
const SIZE_MIN_M = 0.01;
/** Greatest span, metres. */
const SIZE_MAX_M = 1000;

/** Drags a handle of a layer. Shift: the direction in steps of 15°. */
export function createLayerTool(
  index: number,
  grip: LayerGrip,
  lengthText: (m: number) => string,
): Tool {
  let from: { at: Point; layer: Layer } | null = null;
  const settings = (layer: Layer, start: Point, touch: Touch): [LayerSettings, string] => {
    const place = placeOf(layer);
    if (grip === 'place') {
      const x = rounded(place.x + touch.at.x - start.x);
      const y = rounded(place.y + touch.at.y - start.y);
      return [{ place: [x, y] }, `${lengthText(x)}, ${lengthText(y)}`];
    }
    const [dx, dy] = [touch.at.x - place.x, touch.at.y - place.y];
    const size_m = rounded(Math.min(SIZE_MAX_M, Math.max(SIZE_MIN_M, Math.hypot(dx, dy))));
    const free = Math.atan2(dy, dx);
    const angle = rounded(touch.shift ? Math.round(free / TURN_STEP) * TURN_STEP : free);
    const degrees = `${Math.round((angle * 180) / Math.PI)}°`;
    const spans = isUsed(layer, 'size_m');
    return [
      { ...(spans ? { size_m } : {}), ...(turns(layer) ? { angle } : {}) },
      [spans ? lengthText(size_m) : '', turns(layer) ? degrees : ''].filter(Boolean).join(', '),
    ];
  };
  return {
    down(editor, { at }) {
      const layer = layersOf(editor.state.get().show)[index];
      editor.begin();
      from = layer ? { at, layer } : null;
    },
    move(editor, touch) {
      if (!from) return;
      const [changed, hint] = settings(from.layer, from.at, touch);
      editor.change(LABEL, (show) => setLayerSettings(show, index, changed));
      editor.overlay({ ...NO_OVERLAY, hint });
    },
    up(editor) {
      from = null;
      editor.commit(LABEL);
    },
    cancel(editor) {
      const busy = from !== null;
      from = null;
      editor.cancel();
      return busy;
    },
  };
}

const LABEL = 'Place of light';

/** Rounded to a thousandth: metres to a millimetre, radians to a milliradian. */
const rounded = (value: number) => Math.round(value * 1e3) / 1e3 + 0;
