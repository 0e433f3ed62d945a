import { fromHex, toHex, type Rgb } from '../base/colour';
import type { Point } from '../base/geometry';
import { capitalised } from '../base/words';
import { drawnKind } from './drawnLine';
import { list, pair } from '../model/jsonFields';
import type { FrameSource, SourceKind } from '../model/sources';

/** What the Make panel shows: the settings of every kind of source, of which one kind is chosen. */
export interface Draft {
  tab: Tab;
  text: string;
  font: string;
  shape: string;
  /** Settings of shapes that are not the usual ones. */
  shapeNumbers: Readonly<Partial<Record<ShapeNumber, number>>>;
  /** Points of a line that is drawn on the floor, in units of their own; empty: none yet. */
  points: readonly Point[];
  /** Whether the last point of such a line is joined to the first. */
  closed: boolean;
  /** A font of one's own for words; null: `font`. */
  ownFont: DraftFont | null;
  /** The files of the frames: one, or several of which each makes a frame. */
  files: readonly DraftFile[];
  /** The moment of the animation that a single frame shows, seconds; null: the whole animation becomes frames. */
  moment_s: number | null;
  /** What of a picture or animation is shown. */
  way: PictureWay;
  /** Whether the background is shown instead, or the dark instead of the light. */
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
  /** Settings that the panel does not show; they stay. */
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

/** Whether an animation becomes frames that are not known before it is read. */
export const isFilm = (draft: Draft) =>
  draft.tab === 'file' && draft.files[0]?.kind === 'animation' && draft.moment_s === null;

/** Whether a file is seen as a whole, so that what it shows must be found in it. */
export const isSeen = (file: DraftFile | null) =>
  file?.kind === 'picture' || file?.kind === 'animation';

/** The colour of a warm lamp, as the module takes it where a source names none. */
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

/** The draft that a source is. `fileName`: the name of its file for people. */
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

/** The sources that a draft is, one for each frame; none: something is missing, such as the text. */
export function sourcesOf(draft: Draft): FrameSource[] {
  if (draft.tab === 'file') {
    const series = draft.files.length > 1 ? (draft.files[0]?.name ?? null) : null;
    return draft.files.map((file) => ({ ...sourceOf(draft, file), series }));
  }
  if (draft.tab === 'text' && draft.text.trim() === '') return [];
  const isDrawn = drawnKind(draft) !== null;
  // A line without points goes from left to right; the others have none.
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

/** Metres to a tenth of a millimetre, as places of pixels are. */
const mm = (metres: number) => Math.round(metres * 1e4) / 1e4 + 0;

/** A source in a few words, for people. */
export function sourceWords(source: FrameSource, fileName: string | null): string {
  const { text, shape } = source.settings;
  if (source.kind === 'text') return `the words “${String(text ?? '').replaceAll('\n', ' ')}”`;
  if (source.kind === 'shape') return `the shape ${String(shape ?? 'circle')}`;
  return fileName === null ? 'a file' : `the file ${fileName}`;
}

/** A file's name without its ending. */
export const stem = (file: string) => file.replace(/\.[^.]*$/, '') || file;

/** Longest name of a frame, characters. */
const NAME_MAX = 80;

/** A name for a frame that is made of a source; empty: there is none. */
export function sourceTitle(source: FrameSource, fileName: string | null): string {
  const { text, shape } = source.settings;
  if (source.kind === 'text')
    return String(text ?? '')
      .replaceAll('\n', ' ')
      .slice(0, NAME_MAX);
  const name = source.kind === 'shape' ? String(shape ?? 'circle') : stem(fileName ?? '');
  return capitalised(name).slice(0, NAME_MAX);
}
