import { messageOf } from '../base/errors';
import type { MakeFile } from '../api/types.gen';
import { countText } from '../base/numbers';
import { FILE_SOURCES, type DraftFile, type FileSource } from '../make/draft';
import type { Making } from '../make/making';
import { MUSIC_BYTES_MAX } from '../music/decode';
import { DROPPABLE } from '../session/droppable';
import { notify } from '../session/notices';
import type { Session } from '../session/session';
import { uploadShow } from '../session/upload';
import type { Editing } from './editing';
import { openMaking } from './makes';
import { takeMusic } from './music/musicActs';

/** Largest file that is taken, but for music, bytes: more than drawings and photographs have. */
const FILE_BYTES_MAX = 16 * 2 ** 20;

/** Largest file that is read at all, bytes: what it is shows only then. */
const TAKEN_BYTES_MAX = Math.max(FILE_BYTES_MAX, MUSIC_BYTES_MAX);

/** Most files that are taken at once. */
const FILES_MAX = 50;

/** Longest text that is taken as words, characters; longer text is cut. */
export const TEXT_MAX = 200;

/** Takes what was dropped or pasted: files as `takeFiles` does, else the text as words in the Make panel. */
export async function takeAnything(
  session: Session,
  editing: Editing,
  files: readonly File[],
  text: string,
) {
  try {
    const lists = await listsIn(editing, text);
    if (lists.length > 0) await takeFiles(session, editing, lists);
    else if (files.length > 0) await takeFiles(session, editing, files);
    else takeWords(editing, text);
  } catch (error) {
    notify('error', messageOf(error));
  }
}

/** The text as a file, if it is a drawing, a show or a list; else empty. A single line may only be the first two. */
async function listsIn(editing: Editing, text: string): Promise<File[]> {
  const start = text.trimStart().charAt(0);
  const mayBe = start === '<' || start === '{' || start === '[' || text.trim().includes('\n');
  if (!mayBe) return [];
  const { kind } = await editing.maker.look(new TextEncoder().encode(text));
  const name = { svg: 'Pasted.svg', list: 'Pasted.csv', show: 'Pasted.json' }[kind ?? ''];
  return name === undefined ? [] : [new File([text], name)];
}

function takeWords(editing: Editing, text: string) {
  const words = text.trim().slice(0, TEXT_MAX);
  if (words === '') return;
  openMaking(editing, 'text')?.change({ tab: 'text', text: words });
}

/**
 * Takes files by what they are. A show is uploaded and opened, and ends the taking. Music becomes the show's music.
 * Sources of frames, else a font, open the Make panel. A notice names files that cannot be used.
 */
export async function takeFiles(session: Session, editing: Editing, files: readonly File[]) {
  const looked: Looked[] = [];
  for (const file of files.slice(0, FILES_MAX)) {
    const found = await look(editing, file);
    if (found.kind === 'show') return uploadShow(session, file);
    looked.push(found);
  }
  const sources = looked.filter((found) => FILE_SOURCES.includes(found.kind as FileSource));
  const music = editing.files.get(looked.find(({ kind }) => kind === 'music')?.hash ?? '');
  const font = looked.find(({ kind }) => kind === 'font');
  refuse(looked.filter(({ why }) => why !== null));
  if (music) await takeMusic(editing, music);
  if (sources.length > 0) {
    const { used, left } = together(sources.map(draftFile));
    if (left > 0)
      notify('info', `An animation is taken alone: ${countText(left, 'other file')} left out.`);
    openMaking(editing, 'file')?.change({ tab: 'file', files: used, moment_s: null });
  } else if (font) {
    const making = openMaking(editing, 'text');
    making?.change({ tab: 'text', ownFont: { hash: font.hash, name: font.name } });
  }
  if (files.length > FILES_MAX)
    notify('info', `Only the first ${FILES_MAX} of ${files.length} files were taken.`);
}

/** A file that was looked at. */
export interface Looked {
  hash: string;
  name: string;
  kind: MakeFile['kind'];
  /** Why the file cannot be used; null: it can. */
  why: string | null;
}

const draftFile = ({ hash, name, kind }: Looked): DraftFile => ({
  hash,
  name,
  kind: kind as FileSource,
});

/** Finds out what a file is, and keeps it in `editing.files` if it can be used. */
export async function look(editing: Editing, file: File): Promise<Looked> {
  const refused = (why: string): Looked => ({ hash: '', name: file.name, kind: null, why });
  if (file.size > TAKEN_BYTES_MAX) return refused(tooLarge(file.size, TAKEN_BYTES_MAX));
  const bytes = new Uint8Array(await file.arrayBuffer());
  const { hash, kind, error } = await editing.maker.look(bytes);
  if (kind === null) return refused(error?.message ?? 'It is of an unknown kind.');
  if (kind !== 'music' && file.size > FILE_BYTES_MAX)
    return refused(tooLarge(file.size, FILE_BYTES_MAX));
  const mediaType = file.type || 'application/octet-stream';
  editing.files.set(hash, { hash, name: file.name.slice(0, 200), mediaType, bytes });
  return { hash, name: file.name, kind, why: null };
}

const tooLarge = (bytes: number, most: number) =>
  `It has ${Math.ceil(bytes / 2 ** 20)} MiB; use a file of at most ${most / 2 ** 20} MiB.`;

/** Shows a notice about files that cannot be used: why not the first, how many more, and what can be used. */
function refuse(refused: readonly Looked[]) {
  const [first] = refused;
  if (!first) return;
  const more = refused.length > 1 ? ` And ${countText(refused.length - 1, 'more file')}.` : '';
  notify('error', `Can't use ${first.name}: ${first.why}${more} You can use ${DROPPABLE}.`);
}

/** The files that are used together: the first animation alone, else all, by name. `left`: number of the others. */
function together(files: DraftFile[]): { used: DraftFile[]; left: number } {
  const film = files.find(({ kind }) => kind === 'animation');
  if (film) return { used: [film], left: files.length - 1 };
  const inOrder = new Intl.Collator(undefined, { numeric: true });
  return { used: files.sort((a, b) => inOrder.compare(a.name, b.name)), left: 0 };
}

/** Sets the words that are made in the user's own font. */
export async function takeFont(editing: Editing, making: Making, file: File) {
  try {
    const found = await look(editing, file);
    if (found.kind === 'font') making.change({ ownFont: { hash: found.hash, name: found.name } });
    else
      notify(
        'error',
        `Can't use ${file.name}: ${found.why ?? 'It is no font.'} Choose a font as TTF or OTF.`,
      );
  } catch (error) {
    notify('error', messageOf(error));
  }
}
