import type { Obstacle } from '../base/geometry';
import { fromHex, toHex } from '../base/colour';
import { list, number, object, pair, text, without } from './jsonFields';
import { readPart, readSources, writePart, writeSource } from './jsonSources';
import { readMotion } from './motion';
import { EMPTY_STAGE, newKey, type Frame, type Pixel, type Show, type Stage } from './show';

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

const FRAME_FIELDS = [
  'id',
  'name',
  'air_time_s',
  'at_s',
  'transition_s',
  'easing',
  'motion',
  'identity',
  'sources',
  'pixels',
];

function readFrame(value: unknown): Frame {
  const json = object(value);
  return {
    key: newKey(),
    id: typeof json.id === 'string' ? json.id : null,
    name: text(json.name),
    airTime_s: number(json.air_time_s, 0),
    at_s: typeof json.at_s === 'number' ? json.at_s : null,
    transition_s: typeof json.transition_s === 'number' ? json.transition_s : null,
    easing: json.easing === 'gentle' ? 'gentle' : 'swift',
    motion: readMotion(json.motion),
    identity: json.identity === 'fixed' || json.identity === 'any' ? json.identity : null,
    sources: readSources(json.sources),
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
  const color = fromHex(text(json.color)) ?? 0xffffff;
  const group = typeof json.group === 'string' ? json.group : null;
  return { id: number(json.id, 0), x, y, color, robot, part: readPart(json), group };
}

/** Fields of the show that version 2 of the format added. */
const FIELDS_2 = [
  'spares',
  'assets',
  'beats',
  'sections',
  'markers',
  'cues',
  'layers',
  'trajectories',
];

/** Whether a show uses parts of version 2. Without them it is written as version 1, so that older programs read it. */
const usesVersion2 = (show: Show) =>
  FIELDS_2.some((field) => field in show.rest) ||
  show.frames.some(
    (f) =>
      f.id !== null ||
      f.at_s !== null ||
      f.motion !== null ||
      f.sources.length > 0 ||
      f.pixels.some((p) => p.part !== null || p.group !== null),
  );

/** The document as the server reads it; pixels' places are rounded to a tenth of a millimetre. */
export function writeShow(show: Show): unknown {
  return {
    lightbots: usesVersion2(show) ? 2 : 1,
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
    ...(frame.id === null ? {} : { id: frame.id }),
    name: frame.name,
    air_time_s: frame.airTime_s,
    ...(frame.at_s === null ? {} : { at_s: frame.at_s }),
    ...(frame.transition_s === null ? {} : { transition_s: frame.transition_s }),
    easing: frame.easing,
    ...(frame.motion === null ? {} : { motion: frame.motion }),
    ...(frame.identity === null ? {} : { identity: frame.identity }),
    ...(frame.sources.length === 0 ? {} : { sources: frame.sources.map(writeSource) }),
    ...frame.rest,
    pixels: frame.pixels.map((p) => ({
      id: p.id,
      place: [tenths(p.x), tenths(p.y)],
      color: toHex(p.color),
      ...(p.robot === null ? {} : { robot: p.robot }),
      ...writePart(p.part),
      ...(p.group === null ? {} : { group: p.group }),
    })),
  };
}

/** Metres rounded to a tenth of a millimetre; -0 becomes 0. */
const tenths = (metres: number) => Math.round(metres * 1e4) / 1e4 + 0;
