import { list, number, object, pair, text, type Json } from './jsonFields';
import { SOURCE_KINDS, type FloorBox, type FrameSource, type SourcePart } from './sources';

/** The sources of a frame from its JSON; those of an unknown kind are left out. */
export const readSources = (value: unknown): FrameSource[] => list(value).flatMap(readSource);

function readSource(value: unknown): FrameSource[] {
  const json = object(value);
  const kind = SOURCE_KINDS.find((known) => known === json.kind);
  if (kind === undefined) return [];
  return [
    {
      kind,
      asset: typeof json.asset === 'string' ? json.asset : null,
      seed: number(json.seed, 0),
      box: 'box' in json ? readBox(object(json.box)) : null,
      moved: list(json.moved).filter((id) => typeof id === 'number'),
      series: typeof json.series === 'string' ? json.series : null,
      moment_s: typeof json.moment_s === 'number' ? json.moment_s : null,
      settings: object(json.settings),
    },
  ];
}

const readBox = (json: Json): FloorBox => ({ min: pair(json.min), max: pair(json.max) });

export const writeSource = (source: FrameSource): unknown => ({
  kind: source.kind,
  ...(source.asset === null ? {} : { asset: source.asset }),
  ...(source.seed === 0 ? {} : { seed: source.seed }),
  ...(source.box === null ? {} : { box: source.box }),
  ...(source.moved.length === 0 ? {} : { moved: source.moved }),
  ...(source.series === null ? {} : { series: source.series }),
  ...(source.moment_s === null ? {} : { moment_s: source.moment_s }),
  ...(Object.keys(source.settings).length === 0 ? {} : { settings: source.settings }),
});

/** The part of a source that a pixel shows, from the pixel's JSON; null: it shows none. */
export const readPart = (pixel: Json): SourcePart | null =>
  'source' in pixel || 'part' in pixel
    ? { source: number(pixel.source, 0), name: text(pixel.part) }
    : null;

/** The JSON fields of a pixel for its part; source 0 is left out where the part has a name. */
export function writePart(part: SourcePart | null): Json {
  if (part === null) return {};
  const source = part.source === 0 && part.name !== '' ? {} : { source: part.source };
  return part.name === '' ? source : { ...source, part: part.name };
}
