import { expect, test } from 'vitest';
import { addFrame, setFrames } from './commands';
import { createEditor } from './editor';
import { createPreview } from './preview';
import { newShow } from './show';
import { timelineOf } from './timeline';

/** Two frames with an air time of two seconds each, and a timeline on which drives take no time. */
function twoFrames() {
  const show = setFrames(addFrame(newShow('x', 1), 0), [0, 1], { airTime_s: 2 });
  const editor = createEditor(show);
  return { editor, preview: createPreview(editor), timeline: timelineOf(show, null) };
}

test('a preview advances through the frames and stops at the end', () => {
  const { editor, preview, timeline } = twoFrames();
  preview.toggle();
  preview.begin(timeline);
  preview.advance(timeline, 2.5);
  expect([preview.time_s.get(), editor.state.get().frame]).toEqual([2.5, 1]);
  preview.advance(timeline, 2);
  expect([preview.time_s.get(), preview.running.get()]).toEqual([null, false]);
  expect(editor.state.get().frame).toBe(1);
});

test('scrubbing pauses at a moment, and a preview goes on from there', () => {
  const { editor, preview, timeline } = twoFrames();
  preview.toggle();
  preview.scrub(timeline, 3);
  expect([preview.time_s.get(), preview.running.get()]).toEqual([3, false]);
  expect(editor.state.get().frame).toBe(1);
  preview.toggle();
  preview.begin(timeline);
  expect(preview.time_s.get()).toBe(3);
});

test('a preview that is stopped shows the frame as it is drawn', () => {
  const { preview, timeline } = twoFrames();
  preview.scrub(timeline, 1);
  preview.stop();
  expect([preview.time_s.get(), preview.running.get()]).toEqual([null, false]);
});
