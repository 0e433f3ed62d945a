import { expect, test } from 'vitest';
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
