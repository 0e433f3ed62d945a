import { expect, test } from 'vitest';
import { ACCEPTED, exportLabel, stem } from './formats';
import { FORMATS } from './types.gen';

test('the longest ending of a format is cut off', () => {
  expect(stem('3210.JSON')).toBe('3210');
  expect(stem('My stars.lightbots.json')).toBe('My stars');
  expect(stem('notes.txt')).toBe('notes.txt');
  expect(stem('')).toBe('');
});

test('file dialogs and menus follow the table of formats', () => {
  expect(ACCEPTED).toBe(
    '.json,.lightbots,.zip,.skyc,.vviz,.fseq,application/json,application/zip,' +
      'application/skybrush-compiled,application/x-fseq',
  );
  expect(FORMATS.map(exportLabel)).toEqual([
    'Download',
    'Export for LightBots, with its files (.lightbots.zip)',
    'Export for the original LightBots (.json)',
    'Export for Skybrush (.skyc)',
    'Export for Skybrush, as tables (.csv.zip)',
    'Export for Finale 3D and other VVIZ programs (.vviz)',
    'Export for xLights and the Falcon Player (.fseq)',
  ]);
});
