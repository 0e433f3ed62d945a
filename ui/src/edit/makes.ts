import { getAsset, putAsset } from '../api/http';
import { draftOf, isKnown, newDraft, type Draft, type Tab } from '../make/draft';
import { pixelsOf } from '../make/frame';
import { createMaking, type Complete, type Making } from '../make/making';
import { fleetSize, makeFrame } from '../model/commands';
import type { FrameSource } from '../model/sources';
import { notify } from '../session/notices';
import type { Editing } from './editing';

/** Number of robots of a show that has no pixels yet. */
const ROBOTS_USUAL = 30;

/** The frame's only source that the Make panel can show; null: it has none, several, or one of another kind. */
export function sourceToChange(sources: readonly FrameSource[]): FrameSource | null {
  const [source] = sources;
  return source && sources.length === 1 && isKnown(source) ? source : null;
}

/**
 * Opens the Make panel for the frame on the stage, with its source if it has one; `tab`: from a source of this kind, which
 * begins with `fields` if the frame has none that `suits`.
 */
export function openMaking(
  editing: Editing,
  tab?: Tab,
  fields: Partial<Draft> = {},
  suits: (draft: Draft) => boolean = () => true,
) {
  const { editor, making } = editing;
  const frame = editor.current();
  if (!frame || making.get()) return;
  const { show } = editor.state.get();
  const source = sourceToChange(frame.sources);
  const kept = source && draftOf(source, fileName(editing, source.asset) ?? undefined);
  const isSame = kept !== null && (tab === undefined || kept.tab === tab) && suits(kept);
  editing.preview.stop();
  making.set(
    createMaking(editing.maker, {
      show,
      frame,
      robots: fleetSize(show) || ROBOTS_USUAL,
      draft: isSame ? kept : { ...newDraft(tab ?? 'text'), ...fields },
      moved: isSame ? (source?.moved ?? []) : [],
      fileOf: (hash) => fileOf(editing, hash),
    }),
  );
}

/** Closes the Make panel; the frame stays as it was. */
export function closeMaking(editing: Editing) {
  editing.making.get()?.end();
  editing.making.set(null);
}

/** Gives the frame its made pixels, as one step of the history; does nothing while there is nothing to use. */
export async function takeMade(editing: Editing, making: Making) {
  const done = await making.complete();
  if (!done || editing.making.get() !== making) return;
  const { asset } = done.source;
  try {
    if (asset !== null && editing.files.has(asset))
      await putAsset(asset, await fileOf(editing, asset));
  } catch (error) {
    notify('error', `The file is not saved: ${error instanceof Error ? error.message : error}`);
    return;
  }
  if (editing.making.get() !== making) return;
  closeMaking(editing);
  apply(editing, making, done);
}

function apply(editing: Editing, making: Making, { source, answer }: Complete) {
  const made = { source, pixels: pixelsOf(answer) };
  const file = source.asset === null ? undefined : editing.files.get(source.asset);
  const assets = file
    ? { [file.hash]: { name: file.name, media_type: file.mediaType, bytes: file.bytes.length } }
    : {};
  editing.editor.change('Make', (show) => makeFrame(show, making.frame, made, assets));
}

/** Takes a file to make the frame from; answers why not, or null. */
export async function takeFile(
  editing: Editing,
  making: Making,
  file: File,
): Promise<string | null> {
  if (file.size > FILE_BYTES_MAX)
    return `${file.name} has ${Math.ceil(file.size / 2 ** 20)} MiB; use a file of at most 16 MiB.`;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const { hash, kind, error } = await editing.maker.look(bytes);
    if (kind !== 'svg' && kind !== 'picture' && kind !== 'list')
      return error?.message ?? 'No frame can be made from this file. Use an SVG drawing.';
    const mediaType = file.type || 'application/octet-stream';
    editing.files.set(hash, { hash, name: file.name.slice(0, 200), mediaType, bytes });
    making.change({ tab: 'file', file: { hash, name: file.name, kind } });
    return null;
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}

/** Largest file that is taken, bytes: more than drawings and photographs have. */
const FILE_BYTES_MAX = 16 * 2 ** 20;

async function fileOf(editing: Editing, hash: string): Promise<Uint8Array<ArrayBuffer>> {
  return editing.files.get(hash)?.bytes ?? (await getAsset(hash));
}

/** The name of a file of the show, for people. */
export function fileName(editing: Editing, hash: string | null): string | null {
  if (hash === null) return null;
  const assets = editing.editor.state.get().show.rest.assets;
  const asset = (assets as Record<string, { name?: unknown }> | undefined)?.[hash];
  return typeof asset?.name === 'string' && asset.name !== '' ? asset.name : null;
}
