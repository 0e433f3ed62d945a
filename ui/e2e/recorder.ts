import { spawn, type ChildProcess } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

/** Samples a second. */
const RATE_HZ = 48_000;
/** Least absolute value of a sample that counts as a click; full scale is 1. */
const LOUD = 0.08;
/** Least time between the beginnings of two clicks, seconds. */
const APART_S = 0.25;

/** A sound device without a loudspeaker, and the clicks that were played on it. */
export interface Recorder {
  /** Environment variables for the process that plays. */
  env: Record<string, string>;
  /** When the clicks until now began, milliseconds of the machine's clock. */
  clicks_ms(): number[];
  end(): void;
}

/** Starts PulseAudio with a device without a loudspeaker, and records it. Throws if PulseAudio is not installed. */
export async function startRecorder(folder: string): Promise<Recorder> {
  const home = join(folder, 'pulse');
  mkdirSync(home, { recursive: true, mode: 0o700 });
  const socket = join(home, 'native');
  const env = { HOME: home, XDG_RUNTIME_DIR: home, PULSE_SERVER: `unix:${socket}` };
  const started: ChildProcess[] = [];
  const start = (command: string, args: string[]) => {
    const child = spawn(command, args, {
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'ignore'],
    });
    started.push(child);
    return new Promise<ChildProcess>((done, fail) => {
      child.on('error', () => fail(new Error(`${command} is not installed`)));
      child.on('spawn', () => done(child));
    });
  };
  const modules = [
    'module-null-sink sink_name=none rate=48000',
    `module-native-protocol-unix socket=${socket}`,
  ];
  await start('pulseaudio', [
    '-n',
    '--exit-idle-time=-1',
    '--disallow-exit',
    ...modules.flatMap((one) => ['-L', one]),
  ]);
  await new Promise((done) => setTimeout(done, 2000));
  const format = ['--format=s16le', `--rate=${RATE_HZ}`, '--channels=1', '--raw'];
  const tape = await start('parec', ['-d', 'none.monitor', '--latency-msec=10', ...format]);
  const pieces: Buffer[] = [];
  let [bytes, began_ms] = [0, Infinity];
  tape.stdout?.on('data', (piece: Buffer) => {
    pieces.push(piece);
    bytes += piece.length;
    // The piece with the smallest delay tells best when the recording began.
    began_ms = Math.min(began_ms, Date.now() - (1000 * bytes) / 2 / RATE_HZ);
  });
  return {
    env,
    clicks_ms: () => onsets(Buffer.concat(pieces)).map((at_s) => began_ms + 1000 * at_s),
    end: () => started.forEach((child) => child.kill()),
  };
}

/** When loud sounds in a recording begin, seconds. */
function onsets(tape: Buffer): number[] {
  const found: number[] = [];
  for (let i = 0; i + 1 < tape.length; i += 2) {
    const at_s = i / 2 / RATE_HZ;
    if (Math.abs(tape.readInt16LE(i)) < LOUD * 32_768) continue;
    if (at_s - (found[found.length - 1] ?? -1) >= APART_S) found.push(at_s);
  }
  return found;
}
