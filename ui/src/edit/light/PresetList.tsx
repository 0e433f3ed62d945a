import { Button, FileButton } from '@mantine/core';
import { IconPhoto } from '@tabler/icons-react';
import { PresetTiles } from '../../light/PresetTiles';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { useEditing, useEditor } from '../context';
import { addPreset } from './lightActs';
import { addPicture, PICTURE_FILES } from './pictureActs';

/** Presets, one press on which adds it as a layer over the whole show, and a button that adds a picture file. */
export function PresetList({ onAdded }: { onAdded: () => void }) {
  const editing = useEditing();
  const stage = useEditor((s) => s.show.stage);
  const add = (index: number) => {
    const preset = LIGHT_PRESETS[index];
    if (preset) addPreset(editing, preset);
    onAdded();
  };
  return (
    <>
      <PresetTiles label="Presets of light" lights={editing.lights} stage={stage} onPress={add} />
      <FileButton
        accept={PICTURE_FILES}
        onChange={(file) => file && void addPicture(editing, file).then(onAdded)}
        inputProps={{ 'aria-label': 'File of a picture or film' }}
      >
        {(props) => (
          <Button size="xs" variant="default" leftSection={<IconPhoto size={14} />} {...props}>
            Picture or film…
          </Button>
        )}
      </FileButton>
    </>
  );
}
