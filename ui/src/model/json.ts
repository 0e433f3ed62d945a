import type { Obstacle } from '../base/geometry';
import { fromHex, toHex } from '../base/colour';
import { EMPTY_STAGE, newKey, type Frame, type Pixel, type Show, type Stage } from './show';

type Json = Record<string, unknown>;

const object = (value: unknown): Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Json) : {};
const list = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);
const number = (value: unknown, otherwise: number) =>
  typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
const text = (value: unknown) => (typeof value === 'string' ? value : '');
const pair = (value: unknown): [number, number] => {
  const numbers = list(value);
  return [number(numbers[0], 0), number(numbers[1], 0)];
};

/** The fields of an object that the screen does not know. */
function without(json: Json, known: readonly string[]): Json {
  return Object.fromEntries(Object.entries(json).filter(([key]) => !known.includes(key)));
}

/** Reads a document that the server has checked; missing fields get their default. */
export function readShow(document: unknown): Show {
  const json = object(document);
  return {
    name: text(json.name),
    stage: readStage(json.stage),
    identity: json.identity === 'fixed' ? 'fixed' : 'any',
    music: typeof json.music === 'string' ? json.music : null,
    frames: list(json.frames).map(readFrame),
    rest: without(json, ['lightbots', 'name', 'stage', 'identity', 'music', 'frames']),
  };
}

function readStage(value: unknown): Stage {
  const json = object(value);
  return {
    width_m: number(json.width_m, EMPTY_STAGE.width_m),
    depth_m: number(json.depth_m, EMPTY_STAGE.depth_m),
    obstacles: list(json.obstacles).map(readObstacle),
    radius_m: number(object(json.robot).radius_m, EMPTY_STAGE.radius_m),
    rest: without(json, ['width_m', 'depth_m', 'obstacles']),
  };
}

function readObstacle(value: unknown): Obstacle {
  const json = object(value);
  if ('at' in json) {
    const [x, y] = pair(json.at);
    return { kind: 'disc', x, y, radius_m: number(json.radius_m, 0) };
  }
  const [[minX, minY], [maxX, maxY]] = [pair(json.min), pair(json.max)];
  return { kind: 'rect', minX, minY, maxX, maxY };
}

const FRAME_FIELDS = ['name', 'air_time_s', 'transition_s', 'easing', 'identity', 'pixels'];

function readFrame(value: unknown): Frame {
  const json = object(value);
  return {
    key: newKey(),
    name: text(json.name),
    airTime_s: number(json.air_time_s, 0),
    transition_s: typeof json.transition_s === 'number' ? json.transition_s : null,
    easing: json.easing === 'gentle' ? 'gentle' : 'swift',
    identity: json.identity === 'fixed' || json.identity === 'any' ? json.identity : null,
    pixels: list(json.pixels)
      .map(readPixel)
      .sort((a, b) => a.id - b.id),
    rest: without(json, FRAME_FIELDS),
  };
}

function readPixel(value: unknown): Pixel {
  const json = object(value);
  const [x, y] = pair(json.place);
  const robot = typeof json.robot === 'string' ? json.robot : null;
  return { id: number(json.id, 0), x, y, color: fromHex(text(json.color)) ?? 0xffffff, robot };
}

/** The document as the server reads it; places to a tenth of a millimetre. */
export function writeShow(show: Show): unknown {
  return {
    lightbots: 1,
    name: show.name,
    stage: {
      width_m: show.stage.width_m,
      depth_m: show.stage.depth_m,
      obstacles: show.stage.obstacles.map(writeObstacle),
      ...show.stage.rest,
    },
    identity: show.identity,
    ...(show.music === null ? {} : { music: show.music }),
    ...show.rest,
    frames: show.frames.map(writeFrame),
  };
}

function writeObstacle(o: Obstacle): unknown {
  if (o.kind === 'disc') return { at: [o.x, o.y], radius_m: o.radius_m };
  return { min: [o.minX, o.minY], max: [o.maxX, o.maxY] };
}

function writeFrame(frame: Frame): unknown {
  return {
    name: frame.name,
    air_time_s: frame.airTime_s,
    ...(frame.transition_s === null ? {} : { transition_s: frame.transition_s }),
    easing: frame.easing,
    ...(frame.identity === null ? {} : { identity: frame.identity }),
    ...frame.rest,
    pixels: frame.pixels.map((p) => ({
      id: p.id,
      place: [tenths(p.x), tenths(p.y)],
      color: toHex(p.color),
      ...(p.robot === null ? {} : { robot: p.robot }),
    })),
  };
}

/** Metres to a tenth of a millimetre, and no minus before zero. */
const tenths = (metres: number) => Math.round(metres * 1e4) / 1e4 + 0;
