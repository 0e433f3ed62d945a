import { list, number, object, pair } from './jsonFields';

export type Pair = readonly [number, number];

/** How the picture before a frame drives to it, as the document has it. Metres, radians counter-clockwise, seconds. */
export type Motion =
  | { kind: 'travel'; along: readonly Pair[] }
  | { kind: 'turn'; center: Pair; turn: number; size: number }
  | { kind: 'breathe'; center: Pair; size: number; times: number }
  | { kind: 'follow'; along: readonly Pair[] }
  | { kind: 'wave'; radius_m: number; direction: number; length_m: number; times: number }
  | { kind: 'stagger'; direction: number; delay_s: number }
  | { kind: 'morph'; through: readonly (readonly Pair[])[] };

export type MotionKind = Motion['kind'];

/** The motion of a frame in a document that the server has checked; null: the planner's shortest drive. */
export function readMotion(value: unknown): Motion | null {
  const json = object(value);
  const center = json.center === undefined ? ([0, 0] as const) : pair(json.center);
  const direction = number(json.direction, 0);
  const times = number(json.times, 1);
  switch (json.kind) {
    case 'travel':
    case 'follow':
      return { kind: json.kind, along: list(json.along).map(pair) };
    case 'turn':
      return { kind: 'turn', center, turn: number(json.turn, 0), size: number(json.size, 1) };
    case 'breathe':
      return { kind: 'breathe', center, size: number(json.size, 1), times };
    case 'wave': {
      const [radius_m, length_m] = [number(json.radius_m, 0), number(json.length_m, 1)];
      return { kind: 'wave', radius_m, direction, length_m, times };
    }
    case 'stagger':
      return { kind: 'stagger', direction, delay_s: number(json.delay_s, 0) };
    case 'morph':
      return { kind: 'morph', through: list(json.through).map((one) => list(one).map(pair)) };
    default:
      return null;
  }
}

/** Whether the motion moves the picture before as a formation, so that the frame has its pixels at other places. */
export const isOfFormation = (motion: Motion) =>
  motion.kind !== 'stagger' && motion.kind !== 'morph';
