import { number, object, text } from './jsonFields';
import type { Show } from './show';

/** A file of a show, as the document lists it; `bytes` is its size. */
export interface Asset {
  name: string;
  media_type: string;
  bytes: number;
}

/** The files that belong to a show, by hash. */
export function assetsOf(show: Show): ReadonlyMap<string, Asset> {
  const asset = (value: unknown): Asset => {
    const { name, media_type, bytes } = object(value);
    return { name: text(name), media_type: text(media_type), bytes: number(bytes, 0) };
  };
  const all = Object.entries(object(show.rest.assets));
  return new Map(all.map(([hash, value]) => [hash, asset(value)]));
}

/** A file as the document of a show lists it, by its hash. */
export const assetEntry = (
  hash: string,
  name: string,
  mediaType: string,
  bytes: number,
): Readonly<Record<string, Asset>> => ({ [hash]: { name, media_type: mediaType, bytes } });

/** Adds files, listed by hash, to a show; without files the same show. */
export const withAssets = (show: Show, assets: Readonly<Record<string, unknown>>): Show =>
  Object.keys(assets).length === 0
    ? show
    : { ...show, rest: { ...show.rest, assets: { ...object(show.rest.assets), ...assets } } };

const PICTURES = ['image/png', 'image/jpeg', 'image/webp', 'image/gif'];

/** The files of a show that layers of light can project: pictures. A file without a name is named by its hash. */
export const pictureAssets = (show: Show): { hash: string; name: string }[] =>
  [...assetsOf(show)]
    .filter(([, { media_type }]) => PICTURES.includes(media_type))
    .map(([hash, { name }]) => ({ hash, name: name || hash.slice(0, 8) }));
