import { Group, NumberInput, SegmentedControl, Stack, Text, TextInput } from '@mantine/core';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { fleetSize, setFleetSize, setShow, setStage } from '../model/commands';
import { useSession } from '../shell/session';
import { useEditing, useEditor } from './context';

/** The most pixels a frame is given here; larger shows come from files. */
const FLEET_MAX = 2000;

/** Title, fleet and floor. */
export function ShowSection() {
  const { editor, color } = useEditing();
  const { live } = useSession();
  const show = useEditor((s) => s.show);
  const plan = useStore(live.plan);
  const size = (label: string, field: 'width_m' | 'depth_m') => (
    <NumberInput
      label={label}
      size="xs"
      min={0.3}
      max={100}
      step={0.5}
      decimalScale={2}
      value={show.stage[field]}
      onChange={(value) => {
        if (typeof value === 'number' && value >= 0.3)
          editor.change('Floor', (now) => setStage(now, { [field]: value }));
      }}
    />
  );
  return (
    <Stack gap="sm" component="section" aria-label="Show">
      <TextInput
        key={show.name}
        label="Title"
        size="xs"
        defaultValue={show.name}
        maxLength={120}
        onBlur={(event) => {
          const name = event.currentTarget.value.trim();
          if (name !== show.name) editor.change('Title', (now) => setShow(now, { name }));
        }}
      />
      <NumberInput
        label="Robots"
        size="xs"
        min={1}
        max={FLEET_MAX}
        value={fleetSize(show)}
        onChange={(value) => {
          if (typeof value !== 'number' || value < 1 || value === fleetSize(show)) return;
          editor.change('Robots', (now) => setFleetSize(now, value, color.get()));
        }}
      />
      <Group grow gap="xs">
        {size('Floor width, metres', 'width_m')}
        {size('Floor depth, metres', 'depth_m')}
      </Group>
      <Stack gap={4}>
        <Text size="xs">Which robot shows which pixel</Text>
        <SegmentedControl
          aria-label="Which robot shows which pixel"
          size="xs"
          value={show.identity}
          onChange={(value) =>
            editor.change('Identity', (now) => setShow(now, { identity: value as 'any' | 'fixed' }))
          }
          data={[
            { value: 'any', label: 'Whoever is nearest' },
            { value: 'fixed', label: 'Always the same' },
          ]}
        />
      </Stack>
      {plan && !plan.planning ? (
        <Text size="sm" role="status">
          {plan.ok
            ? `Planned and proven: ${clockText(plan.duration_s)}.`
            : 'It cannot be played as it is:'}
        </Text>
      ) : null}
    </Stack>
  );
}
