import { Button, Stack, Text } from '@mantine/core';
import { IconPlus, IconX } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useStore } from '../../base/store';
import { layersOf } from '../../model/layers';
import { useEditing, useEditor, useEditorNow } from '../context';
import { LayerFields } from './LayerFields';
import { LayerList } from './LayerList';
import { PresetList } from './PresetList';

/** Layers of light over the show: what there is, presets to add, and the settings of the chosen one. */
export default function LightPanel() {
  const editing = useEditing();
  const layers = useEditor((s) => layersOf(s.show));
  const chosen = useStore(editing.layer);
  const [isAdding, setAdding] = useState(false);
  const { full, lighting } = editing;
  useEffect(() => {
    lighting.set(true);
    // The plan says which robot shows which pixel: effects along the order of robots need it.
    const stop = full.follow();
    return () => {
      lighting.set(false);
      stop();
    };
  }, [full, lighting]);
  // The fields follow a slider while it is dragged.
  const layer = useEditorNow((s) => (chosen === null ? undefined : layersOf(s.show)[chosen]));
  const isEmpty = layers.length === 0;
  return (
    <Stack gap="md" component="section" aria-label="Light">
      {isEmpty ? (
        <Text size="sm" c="dimmed">
          Light that moves over the robots, while they stand and while they drive. Choose one to
          begin with:
        </Text>
      ) : (
        <Button
          size="xs"
          variant="default"
          aria-expanded={isAdding}
          leftSection={isAdding ? <IconX size={14} /> : <IconPlus size={14} />}
          onClick={() => setAdding(!isAdding)}
        >
          {isAdding ? 'Close' : 'Add light'}
        </Button>
      )}
      {isEmpty || isAdding ? <PresetList onAdded={() => setAdding(false)} /> : null}
      {isEmpty ? null : <LayerList layers={layers} chosen={chosen} />}
      {layer && chosen !== null ? <LayerFields index={chosen} layer={layer} /> : null}
    </Stack>
  );
}
