import { messageOf } from '../base/errors';
import { putAsset } from '../api/http';
import { draftOf, newDraft, sourceTitle, type Draft, type Tab } from '../make/draft';
import { pixelsOf } from '../make/frame';
import { createMaking, type Making } from '../make/making';
import type { Picture } from '../make/pictures';
import { assetEntry } from '../model/assets';
import { fleetSize, makeFrames } from '../model/commands';
import type { FrameSource } from '../model/sources';
import { notify } from '../session/notices';
import type { Editing } from './editing';

/** Number of robots for which pixels are made in a show without pixels. */
const ROBOTS_USUAL = 30;

/** The frame's only source, which the Make panel can change; null: it has none, or several. */
export function sourceToChange(sources: readonly FrameSource[]): FrameSource | null {
  const [source] = sources;
  return source && sources.length === 1 ? source : null;
}

/**
 * Opens the Make panel for the frame on the stage. It begins with the frame's only source if that is of tab `tab` (or
 * `tab` is absent) and `suits`. Else it begins with a new draft with `fields`. If a panel is open already, nothing
 * changes. Answers what is being made; null: there is no frame.
 */
export function openMaking(
  editing: Editing,
  tab?: Tab,
  fields: Partial<Draft> = {},
  suits: (draft: Draft) => boolean = () => true,
): Making | null {
  const { editor, making } = editing;
  const frame = editor.current();
  const open = making.get();
  if (!frame || open) return open;
  const { show } = editor.state.get();
  const source = sourceToChange(frame.sources);
  const kept = source && draftOf(source, fileName(editing, source.asset) ?? undefined);
  const isSame = kept !== null && (tab === undefined || kept.tab === tab) && suits(kept);
  editing.preview.stop();
  const begun = createMaking(editing.maker, {
    show,
    frame,
    robots: fleetSize(show) || ROBOTS_USUAL,
    draft: isSame ? kept : { ...newDraft(tab ?? 'text'), ...fields },
    moved: isSame ? (source?.moved ?? []) : [],
    fileOf: editing.fileOf,
  });
  making.set(begun);
  return begun;
}

/** Closes the Make panel; the frame stays as it was. */
export function closeMaking(editing: Editing) {
  editing.making.get()?.end();
  editing.making.set(null);
}

/** Gives the frame its made pixels as one step of the history, and closes the panel; nothing if nothing can be used. */
export async function takeMade(editing: Editing, making: Making) {
  const pictures = await making.complete();
  if (!pictures || editing.making.get() !== making) return;
  const hashes = new Set(pictures.flatMap(({ source }) => source.asset ?? []));
  try {
    for (const hash of hashes)
      if (editing.files.has(hash)) await putAsset(hash, await editing.fileOf(hash));
  } catch (error) {
    notify('error', `The file is not saved: ${messageOf(error)}`);
    return;
  }
  if (editing.making.get() !== making) return;
  closeMaking(editing);
  apply(editing, making.frame, pictures);
}

function apply(editing: Editing, frame: number, pictures: readonly Picture[]) {
  const before = editing.editor.state.get().show.frames.find(({ key }) => key === frame)?.name;
  const isUnnamed = before !== undefined && /^Frame \d+$/.test(before);
  const titleOf = (source: FrameSource) =>
    isUnnamed ? sourceTitle(source, editing.files.get(source.asset ?? '')?.name ?? null) : null;
  const made = pictures.map(({ source, name, airTime_s, answer }) => ({
    source,
    pixels: pixelsOf(answer),
    ...namedBy(name ?? titleOf(source)),
    ...(airTime_s === null ? {} : { airTime_s }),
  }));
  const files = pictures.flatMap(({ source }) => editing.files.get(source.asset ?? '') ?? []);
  const assets = Object.fromEntries(
    files.flatMap(({ hash, name, mediaType, bytes }) =>
      Object.entries(assetEntry(hash, name, mediaType, bytes.length)),
    ),
  );
  editing.editor.change('Make', (show) => makeFrames(show, frame, made, assets));
}

const namedBy = (name: string | null) => (name ? { name } : {});

/** The name of a file of the show by its hash; null: it has none, or the show does not list it. */
export function fileName(editing: Editing, hash: string | null): string | null {
  if (hash === null) return null;
  const assets = editing.editor.state.get().show.rest.assets;
  const asset = (assets as Record<string, { name?: unknown }> | undefined)?.[hash];
  return typeof asset?.name === 'string' && asset.name !== '' ? asset.name : null;
}
