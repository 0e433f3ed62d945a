import { createStore, type Readable } from '../../base/store';
import { LIGHT_PRESETS } from '../../model/lightPresets';

/** State of MIDI: not asked for, asked for, usable, refused by the user or the browser, or missing in this browser. */
export type PadsState = 'off' | 'asking' | 'on' | 'refused' | 'missing';

/** The parts of Web MIDI that are used, so that tests can replace it. */
export interface PadInput {
  name: string | null;
  onmidimessage: ((event: { data: Uint8Array | null }) => void) | null;
}
export interface PadAccess {
  inputs: { forEach(visit: (input: PadInput) => void): void };
  onstatechange: (() => void) | null;
}

/** Pads of MIDI devices that press lights (presets) and do other acts. */
export interface MidiPads {
  state: Readable<PadsState>;
  /** Names of the devices. */
  devices: Readable<readonly string[]>;
  /** Number of the light or act that gets the next pad that is hit; null: pads press. */
  learning: Readable<number | null>;
  /** Asks the browser for MIDI devices, unless they are there or asked for; the user may have to agree. */
  start(): Promise<void>;
  learn(index: number | null): void;
}

/** Pads of most devices begin at this note and count upwards. */
const FIRST_NOTE = 36;
/** Status of the MIDI message of a pad that is hit, without its channel. */
const NOTE_ON = 0x90;
const KEPT = 'lightbots-pads';

/** Numbers of lights or acts by MIDI note. */
type Notes = Map<number, number>;

/**
 * `press` gets the number of a light, counted from 0. The `others.presses` acts have the numbers after the lights, and
 * no pad until one is learned. `others.hear` gets every message. `request`: null without MIDI.
 */
export function createMidiPads(
  request: (() => Promise<PadAccess>) | null,
  press: (index: number) => void,
  storage: Pick<Storage, 'getItem' | 'setItem'> | null,
  others: { presses: number; hear: (data: Uint8Array) => void } = { presses: 0, hear: () => {} },
): MidiPads {
  const state = createStore<PadsState>(request ? 'off' : 'missing');
  const devices = createStore<readonly string[]>([]);
  const learning = createStore<number | null>(null);
  /** The notes that were learned; they count before the usual ones. */
  const learned = readNotes(storage);

  const hit = (note: number) => {
    const index = learning.get();
    if (index === null) {
      const usual = note - FIRST_NOTE;
      const isLight = usual >= 0 && usual < LIGHT_PRESETS.length;
      const meant = learned.get(note) ?? (isLight ? usual : null);
      if (meant !== null && meant < LIGHT_PRESETS.length + others.presses) press(meant);
      return;
    }
    // A light or act has at most one learned pad.
    for (const [other, preset] of learned) if (preset === index) learned.delete(other);
    learned.set(note, index);
    learning.set(null);
    keep(storage, learned);
  };
  const receive = ({ data }: { data: Uint8Array | null }) => {
    if (data) others.hear(data);
    const [status = 0, note = 0, velocity = 0] = data ?? [];
    if ((status & 0xf0) === NOTE_ON && velocity > 0) hit(note);
  };
  const listen = (access: PadAccess) => {
    const names: string[] = [];
    access.inputs.forEach((input) => {
      input.onmidimessage = receive;
      names.push(input.name ?? 'a device without a name');
    });
    devices.set(names);
  };
  return {
    state,
    devices,
    learning,
    async start() {
      if (!request || state.get() === 'on' || state.get() === 'asking') return;
      state.set('asking');
      try {
        const access = await request();
        access.onstatechange = () => listen(access);
        listen(access);
        state.set('on');
      } catch {
        state.set('refused');
      }
    },
    learn: (index) => learning.set(index),
  };
}

function readNotes(storage: Pick<Storage, 'getItem'> | null): Notes {
  const notes: Notes = new Map();
  try {
    const kept: unknown = JSON.parse(storage?.getItem(KEPT) ?? '{}');
    for (const [note, index] of Object.entries(
      typeof kept === 'object' && kept !== null ? kept : {},
    ))
      if (Number(note) < 128 && Number.isInteger(index)) notes.set(Number(note), Number(index));
  } catch {
    // None is known.
  }
  return notes;
}

function keep(storage: Pick<Storage, 'setItem'> | null, notes: Notes) {
  try {
    storage?.setItem(KEPT, JSON.stringify(Object.fromEntries(notes)));
  } catch {
    // They last as long as the page.
  }
}
