import { Button, FileButton, Select } from '@mantine/core';
import { useMemo } from 'react';
import { useStore } from '../../base/store';
import { pictureOf } from '../../light/pictures';
import { pictureAssets } from '../../model/assets';
import type { Layer } from '../../model/layers';
import { useEditing, useEditor } from '../context';
import { setSettings } from './lightActs';
import { choosePicture, PICTURE_FILES } from './pictureActs';

/** The picture or film that a layer projects: a file of the show, or a new one. */
export function LayerPictureField({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const known = useMemo(
    () => pictureAssets(show).map(({ hash, name }) => ({ value: hash, label: name })),
    [show],
  );
  const hash = pictureOf(layer);
  const error = useStore(editing.lights.pictureErrors, (errors) =>
    hash === null ? undefined : errors.get(hash),
  );
  const isKnown = known.some(({ value }) => value === hash);
  return (
    <>
      <Select
        label="Picture"
        size="xs"
        placeholder={known.length > 0 ? 'Choose a picture of the show' : 'The show has no picture'}
        disabled={known.length === 0}
        allowDeselect={false}
        data={known}
        value={isKnown ? hash : null}
        error={error ?? (hash !== null && !isKnown ? 'Its file is not in the show.' : undefined)}
        onChange={(picture) => picture !== null && setSettings(editing, index, { picture })}
      />
      <FileButton
        accept={PICTURE_FILES}
        onChange={(file) => file && void choosePicture(editing, layer, file)}
        inputProps={{ 'aria-label': 'File of the picture' }}
      >
        {(props) => (
          <Button size="compact-xs" variant="default" {...props}>
            Choose a file…
          </Button>
        )}
      </FileButton>
    </>
  );
}
