import { useEditing } from '../context';
import { SliderField } from '../SliderField';
import { setSettings } from './lightActs';

interface Props {
  index: number;
  /** Name of the layer's setting that the slider changes. */
  setting: string;
  label: string;
  text: string;
  value: number;
  min: number;
  max: number;
  step: number;
}

/** A number of a layer on a slider; a whole drag is one change. */
export function LayerSlider({ index, setting, ...field }: Props) {
  const editing = useEditing();
  const { editor } = editing;
  return (
    <SliderField
      {...field}
      onChange={(value) => {
        editor.begin();
        setSettings(editing, index, { [setting]: value });
      }}
      onChangeEnd={() => editor.commit('Light')}
    />
  );
}
