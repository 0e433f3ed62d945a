import { PresetTiles } from '../../light/PresetTiles';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { useEditing, useEditor } from '../context';
import { addPreset } from './lightActs';

/** Presets; one press adds it over the whole show. */
export function PresetList({ onAdded }: { onAdded: () => void }) {
  const editing = useEditing();
  const stage = useEditor((s) => s.show.stage);
  const add = (index: number) => {
    const preset = LIGHT_PRESETS[index];
    if (preset) addPreset(editing, preset);
    onAdded();
  };
  return (
    <PresetTiles label="Presets of light" lights={editing.lights} stage={stage} onPress={add} />
  );
}
