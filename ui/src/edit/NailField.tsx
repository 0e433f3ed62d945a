import { Button, Checkbox } from '@mantine/core';
import { useStore } from '../base/store';
import { setFrames } from '../model/commands';
import { beginOf, fitNails, IN_TIME_S } from '../model/nails';
import { timelineOf } from '../model/timeline';
import { NumberField } from '../parts/NumberField';
import { useEditing, useEditor } from './context';

/** Fixes the moment of show time at which the frame's picture begins; nothing for the first frame. */
export function NailField() {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const index = useEditor((s) => s.frame);
  const plan = useStore(editing.settled);
  const frame = show.frames[index];
  if (!frame || index === 0) return null;
  const begins_s = plan && beginOf(timelineOf(show, plan), index);
  const set = (at_s: number | null) =>
    editing.editor.change('Fixed time', (now) => {
      const nailed = setFrames(now, [index], { at_s });
      return at_s === null || !plan ? nailed : fitNails(nailed, timelineOf(nailed, plan));
    });
  const isOff = frame.at_s !== null && begins_s !== null && differs(begins_s, frame.at_s);
  return (
    <>
      <Checkbox
        label="Begins at a fixed time"
        size="sm"
        checked={frame.at_s !== null}
        onChange={(event) =>
          set(event.currentTarget.checked ? Math.round((begins_s ?? 0) * 100) / 100 : null)
        }
      />
      {frame.at_s === null ? null : (
        <NumberField
          label="Begins at (s)"
          description={isOff ? `by plan at ${begins_s.toFixed(2)} s` : undefined}
          unit=" s"
          min={0}
          max={86_400}
          step={0.5}
          digits={2}
          value={frame.at_s}
          onChange={set}
        />
      )}
      {isOff ? (
        <Button size="compact-xs" variant="default" onClick={() => set(frame.at_s)}>
          Fit the air times before it
        </Button>
      ) : null}
    </>
  );
}

const differs = (a_s: number, b_s: number) => Math.abs(a_s - b_s) > IN_TIME_S;
