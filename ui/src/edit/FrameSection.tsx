import { Button, Checkbox, Group, SegmentedControl, Stack, Text, TextInput } from '@mantine/core';
import { useStore } from '../base/store';
import { secondsText } from '../base/time';
import { NumberField } from '../parts/NumberField';
import { useSession } from '../session/session';
import * as acts from './acts';
import { useEditing, useEditor } from './context';

/** Name, air time and drive of the chosen frames. */
export function FrameSection() {
  const editing = useEditing();
  const { live } = useSession();
  const index = useEditor((s) => s.frame);
  const frame = useEditor((s) => s.show.frames[s.frame]);
  const count = useEditor((s) => s.frames.size);
  const plan = useStore(live.settled, (p) => p?.transitions[index]);
  if (!frame) return null;
  const least = plan?.least_s;
  const fast = frame.transition_s === null;
  return (
    <Stack gap="sm" component="section" aria-label="Frame">
      <Text size="sm" fw={600}>
        {count > 1 ? `${count} frames` : `Frame ${index + 1}`}
      </Text>
      <Group grow gap="xs">
        <Button size="compact-xs" variant="default" onClick={() => acts.shiftFrames(editing, -1)}>
          Move earlier
        </Button>
        <Button size="compact-xs" variant="default" onClick={() => acts.shiftFrames(editing, 1)}>
          Move later
        </Button>
      </Group>
      <TextInput
        key={`${frame.key} ${frame.name}`}
        label="Name"
        size="xs"
        defaultValue={frame.name}
        maxLength={80}
        onBlur={(event) => acts.setFrames(editing, { name: event.currentTarget.value.trim() })}
        onKeyDown={(event) => {
          if (event.key === 'Enter') event.currentTarget.blur();
        }}
      />
      <NumberField
        label="Air time (s)"
        unit=" s"
        min={0}
        max={3600}
        step={0.5}
        digits={2}
        value={frame.airTime_s}
        onChange={(airTime_s) => acts.setFrames(editing, { airTime_s })}
      />
      <Checkbox
        label="As fast as is safe"
        size="sm"
        checked={fast}
        onChange={(event) =>
          acts.setFrames(editing, {
            transition_s: event.currentTarget.checked ? null : Math.ceil((least ?? 4) * 2) / 2,
          })
        }
      />
      <NumberField
        label="Travel time (s)"
        description={least === undefined ? undefined : `at least ${secondsText(least)}`}
        unit=" s"
        min={0.1}
        max={3600}
        step={0.5}
        digits={2}
        disabled={fast}
        value={frame.transition_s ?? plan?.duration_s ?? null}
        onChange={(transition_s) => acts.setFrames(editing, { transition_s })}
      />
      <Text size="xs">Motion</Text>
      <SegmentedControl
        aria-label="Motion"
        size="xs"
        value={frame.easing}
        onChange={(value) => acts.setFrames(editing, { easing: value as 'swift' | 'gentle' })}
        data={[
          { value: 'swift', label: 'Fast' },
          { value: 'gentle', label: 'Smooth' },
        ]}
      />
      <Text size="xs">Robot assignment</Text>
      <SegmentedControl
        aria-label="Robot assignment"
        size="xs"
        orientation="vertical"
        value={frame.identity ?? 'show'}
        onChange={(value) =>
          acts.setFrames(editing, { identity: value === 'any' || value === 'fixed' ? value : null })
        }
        data={[
          { value: 'show', label: 'Show default' },
          { value: 'any', label: 'Nearest' },
          { value: 'fixed', label: 'Keep from previous frame' },
        ]}
      />
    </Stack>
  );
}
