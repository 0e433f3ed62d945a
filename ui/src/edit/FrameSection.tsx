import { Button, Checkbox, Group, SegmentedControl, Stack, Text, TextInput } from '@mantine/core';
import { useStore } from '../base/store';
import { secondsText } from '../base/time';
import { NumberField } from '../parts/NumberField';
import type { Frame } from '../model/show';
import * as acts from './acts';
import { useEditing, useEditor } from './context';
import { CueField } from './CueField';
import { NailField } from './NailField';

/** Text under a field with values that differ between the chosen frames. */
const DIFFERENT = 'different in these frames';

/** The chosen frames in playing order. */
function useChosenFrames(): readonly Frame[] {
  const frames = useEditor((s) => s.show.frames);
  const chosen = useEditor((s) => s.frames);
  return frames.filter((_, i) => chosen.has(i));
}

/** The value of `of` that all frames share; undefined: they have different ones, or there are no frames. */
function shared<T>(frames: readonly Frame[], of: (frame: Frame) => T): T | undefined {
  const [first, ...others] = frames.map(of);
  return others.every((value) => value === first) ? first : undefined;
}

/** Settings of the chosen frames: order, air time, cue, travel time, motion and assignment; of one also its name. */
export function FrameSection() {
  const editing = useEditing();
  const index = useEditor((s) => s.frame);
  const frame = useEditor((s) => s.show.frames[s.frame]);
  const chosen = useChosenFrames();
  const count = chosen.length;
  const plan = useStore(editing.settled, (p) => p?.transitions[index]);
  if (!frame) return null;
  const least = plan?.least_s;
  const air_s = shared(chosen, (f) => f.airTime_s);
  const travel_s = shared(chosen, (f) => f.transition_s);
  const fast = travel_s === null;
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
      {count === 1 ? (
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
      ) : null}
      <NumberField
        label="Air time (s)"
        unit=" s"
        min={0}
        max={3600}
        step={0.5}
        digits={2}
        description={air_s === undefined ? DIFFERENT : undefined}
        value={air_s ?? null}
        onChange={(airTime_s) => acts.setFrames(editing, { airTime_s })}
      />
      <CueField />
      {count === 1 ? <NailField /> : null}
      <Checkbox
        label="As fast as is safe"
        size="sm"
        checked={fast}
        indeterminate={travel_s === undefined}
        onChange={(event) =>
          acts.setFrames(editing, {
            transition_s: event.currentTarget.checked ? null : Math.ceil((least ?? 4) * 2) / 2,
          })
        }
      />
      <NumberField
        label="Travel time (s)"
        description={
          travel_s === undefined
            ? DIFFERENT
            : least === undefined
              ? undefined
              : `at least ${secondsText(least)}`
        }
        unit=" s"
        min={0.1}
        max={3600}
        step={0.5}
        digits={2}
        disabled={fast}
        value={travel_s === null ? (plan?.duration_s ?? null) : (travel_s ?? null)}
        onChange={(transition_s) => acts.setFrames(editing, { transition_s })}
      />
      <Text size="xs">Motion</Text>
      <SegmentedControl
        aria-label="Motion"
        size="xs"
        value={shared(chosen, (f) => f.easing) ?? ''}
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
        value={shared(chosen, (f) => f.identity ?? 'show') ?? ''}
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
