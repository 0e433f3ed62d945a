import { fromHex, toHex, type Rgb } from '../base/colour';
import type { Point } from '../base/geometry';
import { capitalised } from '../base/words';
import { drawnKind } from './drawnLine';
import { list, pair } from '../model/jsonFields';
import type { FrameSource, SourceKind } from '../model/sources';

/** The settings of the Make panel. Only those of the chosen tab make something, and those that all tabs share. */
export interface Draft {
  tab: Tab;
  text: string;
  font: string;
  shape: string;
  /** Numbers of the shape that differ from its usual ones. */
  shapeNumbers: Readonly<Partial<Record<ShapeNumber, number>>>;
  /** Points of a line that is drawn on the floor, in units of their own; empty: none yet. */
  points: readonly Point[];
  /** Whether the last of `points` is joined to the first. */
  closed: boolean;
  /** A font file of the user for words; null: `font` is used. */
  ownFont: DraftFont | null;
  /** The files that frames are made from, one frame each; an animation makes several. */
  files: readonly DraftFile[];
  /** The moment of the animation that a single frame shows, seconds; null: the whole animation becomes frames. */
  moment_s: number | null;
  /** What of a picture or animation is shown. */
  way: PictureWay;
  /** Whether a picture shows its background instead; with way `tones`: its dark instead of its light. */
  inverted: boolean;
  color: Rgb;
  style: Style;
  /** Longer side of the picture, metres; null: chosen by floor and fleet. */
  size_m: number | null;
  /** Middle of the picture, stage metres; null: the middle of the floor. */
  center: Point | null;
  /** Radians counter-clockwise. */
  turn: number;
  seed: number;
  /** Settings of the source that the panel does not show; they are kept. */
  kept: Readonly<Record<string, unknown>>;
}

export type Tab = 'text' | 'shape' | 'file';

export const STYLES = ['auto', 'filled', 'outline', 'both', 'lines'] as const;
export type Style = (typeof STYLES)[number];

export const WAYS = ['auto', 'silhouette', 'outline', 'tones'] as const;
export type PictureWay = (typeof WAYS)[number];

export type ShapeNumber = 'aspect' | 'count' | 'turns' | 'inner' | 'span';

/** A file that a frame is made from. */
export interface DraftFile {
  hash: string;
  /** Name for people. */
  name: string;
  kind: FileSource;
}

/** The file of a font. */
export interface DraftFont {
  hash: string;
  /** Name for people. */
  name: string;
}

export type FileSource = Extract<SourceKind, 'svg' | 'picture' | 'list' | 'animation'>;

export const FILE_SOURCES: readonly FileSource[] = ['svg', 'picture', 'list', 'animation'];

/** Whether the draft makes frames of a whole animation, a number of them that is known only after reading it. */
export const isFilm = (draft: Draft) =>
  draft.tab === 'file' && draft.files[0]?.kind === 'animation' && draft.moment_s === null;

/** Whether a file is a picture or an animation, so that shapes must be found in its pixels. */
export const isSeen = (file: DraftFile | null) =>
  file?.kind === 'picture' || file?.kind === 'animation';

/** The colour that the module uses where a source names none. */
export const USUAL_COLOR: Rgb = 0xffa500;

export const newDraft = (tab: Tab): Draft => ({
  tab,
  text: '',
  font: 'lato',
  shape: 'heart',
  shapeNumbers: {},
  points: [],
  closed: false,
  ownFont: null,
  files: [],
  moment_s: null,
  way: 'auto',
  inverted: false,
  color: USUAL_COLOR,
  style: 'auto',
  size_m: null,
  center: null,
  turn: 0,
  seed: 1,
  kept: {},
});

const SHOWN = [
  'text',
  'font',
  'colors',
  'color',
  'shape',
  'style',
  'size_m',
  'center',
  'turn',
  'points',
  'closed',
  'way',
  'inverted',
];
const NUMBERS: readonly ShapeNumber[] = ['aspect', 'count', 'turns', 'inner', 'span'];

const tabOf = (kind: SourceKind): Tab =>
  kind === 'text' ? 'text' : kind === 'shape' ? 'shape' : 'file';

/** The settings with which the panel shows a source. `fileName`: the name of its file for people. */
export function draftOf(source: FrameSource, fileName = 'File'): Draft {
  const { settings } = source;
  const text = (name: string, usual: string) =>
    typeof settings[name] === 'string' ? (settings[name] as string) : usual;
  const number = (name: string) =>
    typeof settings[name] === 'number' ? (settings[name] as number) : null;
  const usual = newDraft(tabOf(source.kind));
  const box = source.box;
  const side = box && Math.max(box.max[0] - box.min[0], box.max[1] - box.min[1]);
  const style = STYLES.find((known) => known === settings.style);
  const kind = source.kind as FileSource;
  return {
    ...usual,
    text: text('text', ''),
    font: text('font', usual.font),
    shape: text('shape', usual.shape),
    shapeNumbers: Object.fromEntries(
      NUMBERS.flatMap((name) => (number(name) === null ? [] : [[name, number(name)]])),
    ),
    points: list(settings.points).map((point) => {
      const [x, y] = pair(point);
      return { x, y };
    }),
    closed: settings.closed === true,
    ownFont:
      usual.tab === 'text' && source.asset !== null ? { hash: source.asset, name: fileName } : null,
    files:
      usual.tab === 'file' && source.asset !== null
        ? [{ hash: source.asset, name: fileName, kind }]
        : [],
    moment_s: source.moment_s,
    way: WAYS.find((known) => known === settings.way) ?? 'auto',
    inverted: settings.inverted === true,
    color: colorOf(settings.colors ?? settings.color) ?? usual.color,
    style: style ?? 'auto',
    size_m: number('size_m') ?? side,
    center: centerOf(source),
    turn: number('turn') ?? 0,
    seed: source.seed,
    kept: Object.fromEntries(Object.entries(settings).filter(([name]) => !isShown(name))),
  };
}

function centerOf({ settings, box }: FrameSource): Point | null {
  const [first] = Array.isArray(settings.center) ? (settings.center as unknown[]) : [];
  if (Array.isArray(first)) {
    const [x, y] = pair(first);
    return { x, y };
  }
  return box && { x: (box.min[0] + box.max[0]) / 2, y: (box.min[1] + box.max[1]) / 2 };
}

const isShown = (name: string) => SHOWN.includes(name) || NUMBERS.some((known) => known === name);

const colorOf = (value: unknown): Rgb | undefined => {
  const first: unknown = Array.isArray(value) ? value[0] : value;
  return typeof first === 'string' ? fromHex(first) : undefined;
};

/** The sources that a draft describes, one for each file, else one; empty: something is missing, such as the text. */
export function sourcesOf(draft: Draft): FrameSource[] {
  if (draft.tab === 'file') {
    const series = draft.files.length > 1 ? (draft.files[0]?.name ?? null) : null;
    return draft.files.map((file) => ({ ...sourceOf(draft, file), series }));
  }
  if (draft.tab === 'text' && draft.text.trim() === '') return [];
  const isDrawn = drawnKind(draft) !== null;
  // A straight line may be without points: the module draws one. The other kinds need two points.
  const isBegun = draft.points.length >= 2 || (draft.shape === 'line' && draft.points.length === 0);
  return isDrawn && !isBegun ? [] : [sourceOf(draft, null)];
}

function sourceOf(draft: Draft, file: DraftFile | null): FrameSource {
  const isDrawn = drawnKind(draft) !== null;
  const color = draft.color === USUAL_COLOR ? null : toHex(draft.color);
  const own = {
    text: { text: draft.text, font: draft.font, ...(color === null ? {} : { colors: [color] }) },
    shape: {
      shape: draft.shape,
      ...draft.shapeNumbers,
      ...(isDrawn && draft.points.length > 0
        ? { points: draft.points.map((p) => [mm(p.x), mm(p.y)]) }
        : {}),
      ...(isDrawn && draft.closed ? { closed: true } : {}),
      ...(color === null ? {} : { color: [color] }),
    },
    file: {
      ...(isSeen(file) && draft.way !== 'auto' ? { way: draft.way } : {}),
      ...(isSeen(file) && draft.inverted ? { inverted: true } : {}),
    },
  }[draft.tab];
  return {
    kind: draft.tab === 'file' ? (file?.kind ?? 'svg') : draft.tab,
    asset: (draft.tab === 'text' ? draft.ownFont : file)?.hash ?? null,
    seed: draft.seed,
    box: null,
    moved: [],
    series: null,
    moment_s: file?.kind === 'animation' ? draft.moment_s : null,
    settings: {
      ...draft.kept,
      ...own,
      ...(draft.style === 'auto' ? {} : { style: draft.style }),
      ...(draft.size_m === null ? {} : { size_m: draft.size_m }),
      ...(draft.center === null ? {} : { center: [[mm(draft.center.x), mm(draft.center.y)]] }),
      ...(draft.turn === 0 ? {} : { turn: draft.turn }),
    },
  };
}

/** Metres rounded to a tenth of a millimetre. */
const mm = (metres: number) => Math.round(metres * 1e4) / 1e4 + 0;

/** A source in a few words, for people. */
export function sourceWords(source: FrameSource, fileName: string | null): string {
  const { text, shape } = source.settings;
  if (source.kind === 'text') return `the words “${String(text ?? '').replaceAll('\n', ' ')}”`;
  if (source.kind === 'shape') return `the shape ${String(shape ?? 'circle')}`;
  return fileName === null ? 'a file' : `the file ${fileName}`;
}

/** A file's name without its last ending; the whole name if it is only an ending. */
export const stem = (file: string) => file.replace(/\.[^.]*$/, '') || file;

/** Longest name of a frame, characters. */
const NAME_MAX = 80;

/** A name for a frame that is made of a source, at most `NAME_MAX` characters; may be empty. */
export function sourceTitle(source: FrameSource, fileName: string | null): string {
  const { text, shape } = source.settings;
  if (source.kind === 'text')
    return String(text ?? '')
      .replaceAll('\n', ' ')
      .slice(0, NAME_MAX);
  const name = source.kind === 'shape' ? String(shape ?? 'circle') : stem(fileName ?? '');
  return capitalised(name).slice(0, NAME_MAX);
}
