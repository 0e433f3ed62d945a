import { Button, FileButton, Group, Select, Stack, Textarea } from '@mantine/core';
import type { MakeFont } from '../api/types.gen';
import { useStore } from '../base/store';
import type { Making } from '../make/making';
import { ColourField } from './ColourField';
import { useEditing } from './context';
import { takeFont, TEXT_MAX } from './taking';
import styles from './Make.module.css';

/** Value of the user's own font file in the list of fonts. */
const OWN = 'own file';

/** Words, their font and colour. */
export function WordFields({ making, fonts }: { making: Making; fonts: readonly MakeFont[] }) {
  const draft = useStore(making.draft);
  const editing = useEditing();
  const own = draft.ownFont ? [{ value: OWN, label: draft.ownFont.name }] : [];
  const data = [...own, ...fonts.map(({ name, title }) => ({ value: name, label: title }))];
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
      <Group align="end" gap="xs" wrap="nowrap">
        <Select
          className={styles.font}
          label="Font"
          size="xs"
          allowDeselect={false}
          data={data}
          value={draft.ownFont ? OWN : draft.font}
          onChange={(font) => {
            if (font !== null && font !== OWN) making.change({ font, ownFont: null });
          }}
        />
        <FileButton
          accept=".ttf,.otf,.ttc,font/ttf,font/otf,font/collection"
          onChange={(file) => {
            if (file) void takeFont(editing, making, file);
          }}
          inputProps={{ 'aria-label': 'Font file' }}
        >
          {(props) => (
            <Button size="xs" variant="default" {...props}>
              Font file…
            </Button>
          )}
        </FileButton>
      </Group>
      <ColourField making={making} />
    </Stack>
  );
}
