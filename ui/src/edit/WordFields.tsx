import { Select, Stack, Textarea } from '@mantine/core';
import type { MakeFont } from '../api/types.gen';
import { useStore } from '../base/store';
import type { Making } from '../make/making';
import { ColourField } from './ColourField';

/** Longest text that is taken, characters; longer ones need a font of a millimetre. */
const TEXT_MAX = 200;

/** Words, their font and colour. */
export function WordFields({ making, fonts }: { making: Making; fonts: readonly MakeFont[] }) {
  const draft = useStore(making.draft);
  const data = fonts.map(({ name, title }) => ({ value: name, label: title }));
  return (
    <Stack gap="sm">
      <Textarea
        label="Words"
        description="Shift Enter begins a new line"
        data-first
        autosize
        minRows={1}
        maxRows={5}
        maxLength={TEXT_MAX}
        value={draft.text}
        onChange={(event) => making.change({ text: event.currentTarget.value })}
        onKeyDown={(event) => {
          if (event.key !== 'Enter' || event.shiftKey || event.nativeEvent.isComposing) return;
          event.preventDefault();
          event.currentTarget.form?.requestSubmit();
        }}
      />
      <Select
        label="Font"
        size="xs"
        allowDeselect={false}
        data={data}
        value={draft.font}
        onChange={(font) => making.change({ font: font ?? draft.font })}
      />
      <ColourField making={making} />
    </Stack>
  );
}
