import { Checkbox, Select, TextInput } from '@mantine/core';
import { cueOf, loopFrom } from '../model/cues';
import * as acts from './acts';
import { useEditing, useEditor } from './context';

/** Whether the chosen frames wait for GO, and the name of the cue. */
export function CueField() {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const chosen = useEditor((s) => s.frames);
  const cues = show.frames.filter((_, i) => chosen.has(i)).map((frame) => cueOf(show, frame));
  const waits = cues.every((cue) => cue !== null);
  const [name] = cues;
  return (
    <>
      <Checkbox
        label="Wait for GO after this"
        size="sm"
        checked={waits}
        indeterminate={!waits && cues.some((cue) => cue !== null)}
        onChange={(event) => acts.setCue(editing, event.currentTarget.checked ? '' : null)}
      />
      {waits && cues.length === 1 ? <LoopField /> : null}
      {waits && cues.length === 1 ? (
        <TextInput
          key={`${[...chosen].join()} ${name}`}
          label="Cue"
          placeholder="What GO is given for"
          size="xs"
          maxLength={80}
          defaultValue={name ?? ''}
          onBlur={(event) => acts.setCue(editing, event.currentTarget.value.trim())}
          onKeyDown={(event) => {
            if (event.key === 'Enter') event.currentTarget.blur();
          }}
        />
      ) : null}
    </>
  );
}

/** What the show does at the cue of the frame until GO is given: it waits, or repeats frames. */
function LoopField() {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const index = useEditor((s) => s.frame);
  const from = loopFrom(show, index);
  const frames = show.frames.slice(0, index + 1).map((frame, i) => ({
    value: String(i),
    label: `Repeat from ${i + 1} ${frame.name}`.trim(),
  }));
  const lost = from === 'lost' ? [{ value: 'lost', label: 'Wait: the frame is not here' }] : [];
  return (
    <Select
      label="Until GO"
      size="xs"
      allowDeselect={false}
      data={[{ value: '', label: 'Wait here' }, ...lost, ...frames]}
      value={from === null ? '' : String(from)}
      onChange={(value) => {
        if (value === 'lost' || value === null) return;
        acts.setLoop(editing, index, value === '' ? null : Number(value));
      }}
    />
  );
}
