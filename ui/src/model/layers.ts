import { list, number, object, text, without } from './jsonFields';
import { withId } from './frameIds';
import { listField } from './listField';
import type { Frame, Show } from './show';

/** A layer of light over time; docs/light.md has the settings of each kind. Values are never changed in place. */
export interface Layer {
  /** Word for the effect. */
  kind: string;
  /** Name for people; may be empty. */
  name: string;
  settings: LayerSettings;
  when: LayerWhen;
  /** Fields of the document that the screen does not use, kept unchanged. */
  rest: Readonly<Record<string, unknown>>;
}

export type LayerSettings = Readonly<Record<string, unknown>>;

/** When a layer shines. */
export type LayerWhen =
  | { of: 'show' }
  /** Ids of frames. */
  | { of: 'frames'; first: string; last: string; phase: LayerPhase }
  /** Show time: from the start of the first frame's air time. */
  | { of: 'seconds'; from_s: number; to_s: number };

/**
 * Which part of each of its frames a layer shines in. `whole`: the drive to the frame and its air time; `transition`:
 * the drive alone; `picture`: the air time alone.
 */
export type LayerPhase = 'whole' | 'transition' | 'picture';

const LAYERS = listField('layers', readLayer, writeLayer);

/** The layers of a show, lowest first; the same list for the same document. */
export const layersOf = LAYERS.of;

export const withLayers = LAYERS.with;

const FIELDS = ['kind', 'name', 'settings', 'frames', 'phase', 'from_s', 'to_s'];

function readLayer(value: unknown): Layer {
  const json = object(value);
  return {
    kind: text(json.kind),
    name: text(json.name),
    settings: object(json.settings),
    when: readWhen(json),
    rest: without(json, FIELDS),
  };
}

function readWhen(json: Readonly<Record<string, unknown>>): LayerWhen {
  if (Array.isArray(json.frames)) {
    const [first, last] = list(json.frames).map(text);
    const phase =
      json.phase === 'transition' || json.phase === 'picture' ? json.phase : ('whole' as const);
    return { of: 'frames', first: first ?? '', last: last ?? first ?? '', phase };
  }
  if (!('from_s' in json) && !('to_s' in json)) return { of: 'show' };
  const from_s = number(json.from_s, 0);
  return { of: 'seconds', from_s, to_s: number(json.to_s, from_s) };
}

/** The layer as it stands in a show's document. */
export function writeLayer({ kind, name, settings, when, rest }: Layer): Record<string, unknown> {
  return {
    ...(name === '' ? {} : { name }),
    kind,
    ...(when.of === 'frames' ? { frames: [when.first, when.last], phase: when.phase } : {}),
    ...(when.of === 'seconds' ? { from_s: when.from_s, to_s: when.to_s } : {}),
    ...(Object.keys(settings).length === 0 ? {} : { settings }),
    ...rest,
  };
}

/** Puts a layer over all others. */
export const addLayer = (show: Show, layer: Layer): Show =>
  withLayers(show, [...layersOf(show), layer]);

export const removeLayer = (show: Show, index: number): Show =>
  withLayers(
    show,
    layersOf(show).filter((_, i) => i !== index),
  );

export const duplicateLayer = (show: Show, index: number): Show =>
  withLayers(
    show,
    layersOf(show).flatMap((layer, i) => (i === index ? [layer, layer] : [layer])),
  );

/** Moves a layer so that it has the index `to` afterwards; an index out of range changes nothing. */
export function moveLayer(show: Show, index: number, to: number): Show {
  const layers = [...layersOf(show)];
  const [moved] = layers.splice(index, 1);
  if (!moved || to === index || to < 0 || to > layers.length) return show;
  layers.splice(to, 0, moved);
  return withLayers(show, layers);
}

export function setLayer(
  show: Show,
  index: number,
  fields: Partial<Pick<Layer, 'name' | 'kind' | 'when'>>,
): Show {
  const layer = layersOf(show)[index];
  if (!layer || Object.entries(fields).every(([k, v]) => layer[k as keyof Layer] === v))
    return show;
  return replaced(show, index, { ...layer, ...fields });
}

/** Changes settings of a layer; undefined takes one out, so that its default counts. */
export function setLayerSettings(show: Show, index: number, settings: LayerSettings): Show {
  const layer = layersOf(show)[index];
  if (!layer || Object.entries(settings).every(([k, v]) => layer.settings[k] === v)) return show;
  const all = Object.entries({ ...layer.settings, ...settings });
  const given = Object.fromEntries(all.filter(([, value]) => value !== undefined));
  return replaced(show, index, { ...layer, settings: given });
}

const replaced = (show: Show, index: number, layer: Layer): Show =>
  withLayers(
    show,
    layersOf(show).map((other, i) => (i === index ? layer : other)),
  );

/** Lets a layer shine in the frames between two indices, both included, in either order. */
export function setLayerFrames(
  show: Show,
  index: number,
  [first, last]: readonly [number, number],
  phase: LayerPhase,
): Show {
  const begun = withId(show, Math.min(first, last));
  const ended = begun && withId(begun[0], Math.max(first, last));
  if (!ended) return show;
  return setLayer(ended[0], index, {
    when: { of: 'frames', first: begun[1], last: ended[1], phase },
  });
}

const indices = new WeakMap<readonly Frame[], ReadonlyMap<string | null, number>>();

/** Indices of frames by their ids; the timeline asks at each step of a drag, for each layer. */
function indicesOf(frames: readonly Frame[]): ReadonlyMap<string | null, number> {
  const known = indices.get(frames);
  if (known) return known;
  const made = new Map(frames.map((frame, index) => [frame.id, index]));
  indices.set(frames, made);
  return made;
}

/** Indices of a layer's first and last frame; null: it is not of frames, or the show lacks one of them. */
export function framesOf(show: Show, { when }: Layer): readonly [number, number] | null {
  if (when.of !== 'frames') return null;
  const places = indicesOf(show.frames);
  const [first, last] = [places.get(when.first), places.get(when.last)];
  return first === undefined || last === undefined ? null : [first, last];
}

/**
 * Mends layers of frames in `show`, in which frames of `before` were moved or taken out. If a layer's first frame now
 * comes after its last, the two change places. If its first or last frame is gone, the layer covers the span of the
 * frames that are left of it. A layer without any is removed.
 */
export function keepLayersInFrames(before: Show, show: Show): Show {
  let now = show;
  for (let index = layersOf(now).length - 1; index >= 0; index--) {
    const layer = layersOf(now)[index];
    if (layer?.when.of !== 'frames') continue;
    const was = framesOf(before, layer);
    const is = framesOf(now, layer);
    if (!was || (is && is[0] <= is[1])) continue;
    const keys = new Set(before.frames.slice(was[0], was[1] + 1).map((frame) => frame.key));
    const left = is ?? now.frames.flatMap((frame, i) => (keys.has(frame.key) ? [i] : []));
    const [first, last] = [left[0], left[left.length - 1]];
    now =
      first === undefined || last === undefined
        ? removeLayer(now, index)
        : setLayerFrames(now, index, [first, last], layer.when.phase);
  }
  return now;
}
