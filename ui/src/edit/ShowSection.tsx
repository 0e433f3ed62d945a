import { Stack, Text, TextInput } from '@mantine/core';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { setShow } from '../model/commands';
import { useEditing, useEditor } from './context';

/** Title of the show, and the verdict of the plan. */
export function ShowSection() {
  const { editor, ...editing } = useEditing();
  const title = useEditor((s) => s.show.name);
  const plan = useStore(editing.plan);
  return (
    <Stack gap="sm" component="section" aria-label="Show">
      <TextInput
        key={title}
        label="Title"
        size="xs"
        defaultValue={title}
        maxLength={120}
        onBlur={(event) => {
          const name = event.currentTarget.value.trim();
          if (name !== title) editor.change('Title', (now) => setShow(now, { name }));
        }}
      />
      {plan && !plan.planning ? (
        <Text size="sm" role="status">
          {plan.ok ? `Collision-free · ${clockText(plan.duration_s)}` : 'Fix before playing:'}
        </Text>
      ) : null}
    </Stack>
  );
}
