import { messageOf } from '../../base/errors';
import { putAsset } from '../../api/http';
import { stem } from '../../make/draft';
import { assetEntry, withAssets } from '../../model/assets';
import { addLayer, layersOf, setLayerSettings, type Layer } from '../../model/layers';
import { notify } from '../../session/notices';
import type { Editing } from '../editing';
import { look, type Looked } from '../taking';

/** Endings and media types of files that a layer can project, for a file chooser. */
export const PICTURE_FILES = '.png,.jpg,.jpeg,.webp,.gif,image/png,image/jpeg,image/webp,image/gif';

/** Lets a layer project a file, unless the layer changed while the file was read. A failure is shown as a notice. */
export async function choosePicture(editing: Editing, layer: Layer, file: File) {
  const taken = await take(editing, file);
  if (!taken) return;
  editing.editor.change('Picture of light', (show) => {
    const index = layersOf(show).indexOf(layer);
    if (index < 0) return show;
    return setLayerSettings(withAssets(show, taken.assets), index, { picture: taken.hash });
  });
}

/** Adds a layer over all others that projects a file as wide as the floor, and chooses it. */
export async function addPicture(editing: Editing, file: File) {
  const taken = await take(editing, file);
  if (!taken) return;
  editing.editor.change('Light: Picture', (show) => {
    const settings = { picture: taken.hash, size_m: show.stage.width_m, speed_hz: 0.25 };
    const layer: Layer = {
      kind: 'picture',
      name: stem(file.name).slice(0, 80),
      settings,
      when: { of: 'show' },
      rest: {},
    };
    return addLayer(withAssets(show, taken.assets), layer);
  });
  editing.layer.set(layersOf(editing.editor.state.get().show).length - 1);
}

interface Taken {
  hash: string;
  assets: Readonly<Record<string, unknown>>;
}

/** Sends a picture file to the server, so that shows can name it; null: it cannot be used, and a notice says why. */
async function take(editing: Editing, file: File): Promise<Taken | null> {
  try {
    const looked = await look(editing, file);
    const kept = editing.files.get(looked.hash);
    if (!kept || (looked.kind !== 'picture' && looked.kind !== 'animation')) {
      notify('error', `Can't use ${file.name}: ${whyNot(looked)}`);
      return null;
    }
    await putAsset(kept.hash, kept.bytes);
    const { hash, name, mediaType, bytes } = kept;
    return { hash, assets: assetEntry(hash, name, mediaType, bytes.length) };
  } catch (error) {
    notify('error', `The picture is not saved: ${messageOf(error)}`);
    return null;
  }
}

const whyNot = ({ why }: Looked) =>
  why ?? 'It has no pixels. Use a PNG, JPEG, WebP or GIF, or save the drawing as PNG.';
