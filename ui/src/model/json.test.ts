import { expect, test } from 'vitest';
import { addFrame, duplicateFrames, placePixels, setFrames, setStage } from './commands';
import { createEditor } from './editor';
import { readShow, writeShow } from './json';

const document = {
  lightbots: 1,
  name: 'Stars',
  stage: {
    width_m: 4,
    depth_m: 3,
    obstacles: [
      { at: [0, 1], radius_m: 0.2 },
      { min: [-1, -1], max: [0, 0] },
    ],
    robot: { radius_m: 0.03, speed_mps: 0.2 },
  },
  identity: 'fixed',
  music: 'tune.mp3',
  starts: [[0, 0]],
  frames: [
    {
      name: 'One',
      air_time_s: 0.5,
      transition_s: 4,
      easing: 'gentle',
      identity: 'any',
      pixels: [
        { id: 0, place: [0.1, -0.2], color: '#ffa500', robot: 'abc' },
        { id: 1, place: [0, 0.1235], color: '#000000' },
      ],
    },
  ],
};

test('a document comes back as it was, with what the screen does not know', () => {
  expect(writeShow(readShow(document))).toEqual(document);
});

const withEveryPart = {
  ...document,
  lightbots: 2,
  spares: 2,
  assets: { ['a7'.repeat(32)]: { name: 'logo.svg', media_type: 'image/svg+xml', bytes: 1234 } },
  beats: { bpm: 120, offset_s: 0.35, per_bar: 4 },
  sections: [{ name: 'Verse', from_s: 0, to_s: 16 }],
  markers: [{ name: 'Drop', at_s: 12.5 }],
  cues: [{ name: 'Curtain', frame: 'one' }],
  layers: [{ kind: 'fire', frames: ['one', 'one'], settings: { palette: [[0, '#ff0000'], null] } }],
  trajectories: [{ frame: 'one', pixel: 0, start: [0, 0], pieces: [[2, 0.123456789, 0]] }],
  frames: [
    {
      ...document.frames[0],
      id: 'one',
      at_s: 12.3456789,
      sources: [
        { kind: 'text', settings: { text: 'HI' } },
        {
          kind: 'animation',
          asset: 'a7'.repeat(32),
          seed: 7,
          box: { min: [-1, -0.123456], max: [1, 0.5] },
          moved: [1],
          series: 'logo',
          moment_s: 0.4,
        },
      ],
      pixels: [
        { id: 0, place: [0.1, -0.2], color: '#ffa500', part: 'H' },
        { id: 1, place: [0, 0.1235], color: '#000000', source: 1, part: 'eye' },
        { id: 2, place: [0.2, 0.1], color: '#000000', source: 0 },
      ],
    },
  ],
};

test('every part of version 2 comes back as it was', () => {
  expect(writeShow(readShow(withEveryPart))).toEqual(withEveryPart);
});

test('every part of version 2 outlives edits', () => {
  const editor = createEditor(readShow(withEveryPart));
  editor.change('Move', (show) => placePixels(show, 0, new Map([[0, { x: 0.3, y: 0.3 }]])));
  editor.change('Frame', (show) => setFrames(show, [0], { name: 'Two' }));
  editor.change('Floor', (show) => setStage(show, { width_m: 5 }));
  const frame = withEveryPart.frames[0] ?? expect.fail();
  const [first, ...others] = frame.pixels;
  const [source, ...sources] = frame.sources;
  // A pixel that is moved by hand stays when its source is made again.
  const moved = { ...source, moved: [0] };
  expect(writeShow(editor.state.get().show)).toEqual({
    ...withEveryPart,
    stage: { ...document.stage, width_m: 5 },
    frames: [
      {
        ...frame,
        name: 'Two',
        sources: [moved, ...sources],
        pixels: [{ ...first, place: [0.3, 0.3] }, ...others],
      },
    ],
  });
});

test('copies of a frame take no id, no absolute time and no part without a source', () => {
  const show = readShow(withEveryPart);
  expect(duplicateFrames(show, [0]).frames[1]).toMatchObject({ id: null, at_s: null });
  expect(duplicateFrames(show, [0]).frames[1]?.sources).toHaveLength(2);
  const added = addFrame(show, 0).frames[1];
  expect(added?.sources).toEqual([]);
  expect(added?.pixels.every((pixel) => pixel.part === null)).toBe(true);
});

test('a show stays version 1 until it uses a part of version 2', () => {
  const show = readShow(document);
  expect(writeShow(show)).toMatchObject({ lightbots: 1 });
  const frames = show.frames.map((frame) => ({ ...frame, at_s: 3 }));
  expect(writeShow({ ...show, frames })).toMatchObject({ lightbots: 2 });
});

test('pixels are sorted, missing fields get defaults, junk does not throw', () => {
  const show = readShow({ frames: [{ pixels: [{ id: 2 }, { id: 1, place: 'x', color: 7 }] }] });
  expect(show.frames[0]?.pixels.map((p) => p.id)).toEqual([1, 2]);
  expect(show.stage.width_m).toBe(3);
  for (const junk of [null, 7, 'x', [], { frames: 3 }, { frames: [null] }]) readShow(junk);
});

test('as fast as legal is the absence of a time', () => {
  const show = readShow({ frames: [{ pixels: [] }] });
  expect(show.frames[0]?.transition_s).toBeNull();
  expect(JSON.stringify(writeShow(show))).not.toContain('transition_s');
});

test('a frame that says nothing of identity is as the show', () => {
  const [frame] = readShow({ identity: 'fixed', frames: [{ pixels: [] }] }).frames;
  expect(frame?.identity).toBeNull();
  expect(writeShow(readShow({ frames: [{ pixels: [], identity: 'fixed' }] }))).toMatchObject({
    frames: [{ identity: 'fixed' }],
  });
});
