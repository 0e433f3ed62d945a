// Made from crates/api by `cargo run -p lightbots-api --example types`. Change it there.

/**
 * A message to a screen. After `hello` come `show`, `plan`, `fleet` and the last lines of the log, then each of them
 * again when it changes, and `state` twenty times a second, if the screen keeps up: it says `took` after each, and one
 * that has several before it gets no more. Before each `state` comes a binary message, the robots.
 */
export type ToScreen = { "type": "hello" } & Hello | { "type": "show" } & OpenShow | { "type": "plan" } & Plan | { "type": "fleet" } & Fleet | { "type": "state" } & State | { "type": "log" } & LogLine | { "type": "answer" } & Answer;

/**
 * Everything a screen says on the WebSocket.
 */
export type FromScreen = { "type": "operate" } & Request | { "type": "took" };

/**
 * Who the server is.
 */
export type Hello = { 
/**
 * Version of the program.
 */
version: string, 
/**
 * Number of this screen among all that ever connected.
 */
screen: number, 
/**
 * How many simulated robots this server runs.
 */
simulated: number, 
/**
 * Whether anyone on the network can reach this server, and drive the robots: there is no sign-in.
 */
open_to_network: boolean, };

/**
 * The show that is open on every screen.
 */
export type OpenShow = { 
/**
 * Counts up with every change.
 */
revision: number, 
/**
 * Its name in the library; null: nothing is open.
 */
name: string | null, 
/**
 * Its version in the library, for `If-Match`.
 */
etag: string | null, 
/**
 * The document as a `.lightbots.json` file holds it; null: nothing is open.
 */
document: unknown, };

/**
 * Who shows which pixel, how they get there, and what is in the way.
 */
export type Plan = { 
/**
 * Revision of the open show it was made for; 0 for a check of another document.
 */
revision: number, 
/**
 * Whether the server is still planning that revision; what follows is then empty.
 */
planning: boolean, 
/**
 * Whether the show can be played.
 */
ok: boolean, 
/**
 * The whole show's running time, seconds: drives and air times.
 */
duration_s: number, 
/**
 * No show with these frames is shorter, seconds.
 */
lower_bound_s: number, 
/**
 * The least distance of two centres, metres; null with fewer than two robots.
 */
closest_m: number | null, 
/**
 * The share of all moments at which any one robot may stop dead without a contact, 0 to 1.
 */
stop_safe: number, 
/**
 * How long planning took, milliseconds.
 */
plan_ms: number, 
/**
 * What is wrong or worth knowing, in the order of frames.
 */
issues: Array<Issue>, 
/**
 * One entry a frame: `transitions[k]` is the drive to frame `k`. Shorter where planning failed.
 */
transitions: Array<Transition>, };

/**
 * The drive to one frame.
 */
export type Transition = { 
/**
 * The frame before, counted from 0; null for the drive from the starting places.
 */
from: number | null, 
/**
 * The frame it leads to, counted from 0.
 */
to: number, 
/**
 * How long it takes, seconds.
 */
duration_s: number, 
/**
 * The least duration that is legal, seconds.
 */
least_s: number, 
/**
 * Bottleneck distance over top speed, seconds.
 */
lower_bound_s: number, 
/**
 * The least distance of two centres, metres.
 */
closest_m: number | null, 
/**
 * The share of its moments at which any one robot may stop dead without a contact, 0 to 1.
 */
stop_safe: number, 
/**
 * `pixels[robot]`: the pixel a robot shows afterwards; null: it stands by. Empty in the `plan` message of the
 * WebSocket, full over HTTP.
 */
pixels: Array<number | null>, 
/**
 * `paths[robot]`, each lasting `duration_s`. Empty in the `plan` message of the WebSocket, full over HTTP.
 */
paths: Array<Path>, };

/**
 * A timed path: cubic Bézier pieces whose parameter is proportional to time.
 */
export type Path = { 
/**
 * Where it starts: x and y, stage metres.
 */
start: [number, number], 
/**
 * `[seconds, c1x, c1y, c2x, c2y, end x, end y]`: duration, two control points and end, stage metres. A piece
 * starts where the one before ends.
 */
pieces: Array<[number, number, number, number, number, number, number]>, };

/**
 * One thing that is wrong or worth knowing.
 */
export type Issue = { 
/**
 * What it is, for programs, such as `pixel-off-floor`.
 */
code: string, 
/**
 * How bad it is.
 */
severity: Severity, 
/**
 * Which frame, counted from 0.
 */
frame: number | null, 
/**
 * Ids of the pixels it is about; may be empty.
 */
pixels: Array<number>, 
/**
 * One line for people; frames are named and counted from 1.
 */
message: string, };

/**
 * How bad an issue is.
 */
export type Severity = "note" | "warning" | "error";

/**
 * Every robot the controller knows, sent when something in it changed.
 */
export type Fleet = { 
/**
 * Counts up whenever robots are added or removed; a `State` with the same number lists robots in this order.
 */
revision: number, 
/**
 * One row a robot, in the order of `State`.
 */
rows: Array<FleetRow>, };

/**
 * One robot.
 */
export type FleetRow = { 
/**
 * Its name on the wire, usually a UUID.
 */
id: string, 
/**
 * What it says it is doing.
 */
status: RobotStatus, 
/**
 * Whether it can be counted on.
 */
presence: Presence, 
/**
 * How long ago it was last heard, seconds.
 */
age_s: number, 
/**
 * Charge, percent; null: it does not say.
 */
battery: number | null, 
/**
 * Id of the pixel it shows, or shall show next; null: it stands by.
 */
pixel: number | null, 
/**
 * Name and version of its firmware; null: it does not say, as original robots do not.
 */
firmware: string | null, 
/**
 * What it can do beyond the original protocol.
 */
abilities: Abilities, 
/**
 * How far its clock may be off, microseconds; null: not synchronised.
 */
clock_us: number | null, 
/**
 * Whether it says that it is simulated. Every other robot is real, and a fleet with one such robot is a real fleet.
 */
simulated: boolean, };

/**
 * What a robot is doing. In `State` it is the index in this order, from 0.
 */
export type RobotStatus = "idle" | "ready" | "driving" | "held" | "lost" | "cut" | "faulty";

/**
 * How long a robot has been silent.
 */
export type Presence = "active" | "stale" | "gone";

/**
 * What a robot can do beyond TARGET, COLOR and UUID.
 */
export type Abilities = { 
/**
 * It follows timed paths.
 */
route: boolean, 
/**
 * It fades its light.
 */
fade: boolean, 
/**
 * It blinks to be found.
 */
blink: boolean, };

/**
 * A snapshot of the run. Where the robots are is said just before, in a message of its own: `Robots`.
 */
export type State = { 
/**
 * The show clock, milliseconds.
 */
at_ms: number, 
/**
 * How fast it goes: 1 is real time, less where this machine is too slow for its simulated robots.
 */
pace: number, 
/**
 * Which `Fleet` names the robots of the message before.
 */
fleet: number, 
/**
 * The broker.
 */
broker: Broker, 
/**
 * The show.
 */
playback: Playback, };

/**
 * The connection to the broker.
 */
export type Broker = { 
/**
 * Its addresses, with commas between them, without user and password; empty: none is wanted.
 */
address: string, 
/**
 * How far it is.
 */
phase: BrokerPhase, 
/**
 * Whether it answers: `phase` is `connected`.
 */
connected: boolean, 
/**
 * Which of its addresses is in use; null: none.
 */
node: string | null, 
/**
 * Why not, one line for people: what, where, and what to do.
 */
reason: string | null, };

/**
 * How far the connection to the broker is.
 */
export type BrokerPhase = "off" | "connecting" | "connected" | "retrying";

/**
 * What a form for the broker begins with. Passwords and keys never leave the server.
 */
export type BrokerSettings = { 
/**
 * The broker that is used, or was last: addresses without login, with commas between them, or `embedded`.
 */
address: string, 
/**
 * User name; null: none.
 */
user: string | null, 
/**
 * Whether a password is kept for it.
 */
has_password: boolean, 
/**
 * The authority to trust, as it was stated: PEM text, or a file on the server's machine; null: the system's.
 */
ca: string | null, 
/**
 * Our own certificate, as it was stated; null: none.
 */
client_cert: string | null, 
/**
 * Whether its key is kept.
 */
has_client_key: boolean, 
/**
 * Address of the server's own broker; null: it runs none, and `embedded` is refused.
 */
embedded: string | null, };

/**
 * What is being played.
 */
export type Playback = { 
/**
 * What is going on.
 */
phase: Phase, 
/**
 * What the run is doing, for people, such as `driving`; null: there is no run.
 */
doing: string | null, 
/**
 * The frame that is shown or driven to, counted from 0; null: none.
 */
frame: number | null, 
/**
 * How many frames the open show has.
 */
frames: number, 
/**
 * How much of the drive to `frame` is done, 0 to 1; 1 during its air time.
 */
progress: number, 
/**
 * Time left to the end of the show, seconds, as far as it is known.
 */
left_s: number | null, 
/**
 * Where and why the last run failed, a sentence for people; until it is dismissed or robots are started again.
 */
failure: string | null, 
/**
 * Whether it begins again after the last frame.
 */
looping: boolean, 
/**
 * Names of the robots everybody is waiting for; at most twenty.
 */
late: Array<string>, };

/**
 * What is going on.
 */
export type Phase = "idle" | "ready" | "preparing" | "playing" | "paused" | "preview" | "aborting";

/**
 * The robots, one entry each in every list, in the order of the fleet table.
 */
export type Robots = { 
/**
 * Measured place along x, stage metres, to 0.1 mm; NaN: unknown.
 */
x: Float32Array, 
/**
 * Measured place along y, stage metres, to 0.1 mm; NaN: unknown.
 */
y: Float32Array, 
/**
 * Where its path says it is now along x, stage metres; NaN: it drives no path. Never draw it as if measured.
 */
planned_x: Float32Array, 
/**
 * Where its path says it is now along y, stage metres.
 */
planned_y: Float32Array, 
/**
 * Where its pixel is along x, stage metres; NaN: it stands by.
 */
goal_x: Float32Array, 
/**
 * Where its pixel is along y, stage metres; NaN: it stands by.
 */
goal_y: Float32Array, 
/**
 * Colour of the light: R·65536 + G·256 + B.
 */
colour: Uint32Array, 
/**
 * What it is doing: index into `RobotStatus` in its order, from 0.
 */
status: Uint8Array, };

/**
 * A line of the log.
 */
export type LogLine = { 
/**
 * Its number. A line with a number that was there before takes that line's place: it has grown.
 */
id: number, 
/**
 * When, milliseconds since 1970; of the first where it sums up many events.
 */
time_ms: number, 
/**
 * How grave.
 */
level: Level, 
/**
 * One line for people.
 */
text: string, 
/**
 * How many robots it is about, where it sums up what happened to several; else 0.
 */
count: number, 
/**
 * Names of the first of them.
 */
robots: Array<string>, };

/**
 * How grave a line of the log is.
 */
export type Level = "debug" | "info" | "warn" | "error";

/**
 * A numbered wish.
 */
export type Request = { 
/**
 * Chosen by the screen; the answer repeats it.
 */
id: number, 
/**
 * What to do.
 */
operation: Operation, };

/**
 * What can be done with show and fleet. Frames are counted from 0.
 */
export type Operation = { "do": "play", 
/**
 * The first frame to show.
 */
from: number, 
/**
 * What to do where robots are missing.
 */
missing: Missing, } | { "do": "preview", 
/**
 * Which.
 */
frame: number, 
/**
 * What to do where robots are missing.
 */
missing?: Missing, } | { "do": "pause" } | { "do": "resume" } | { "do": "step" } | { "do": "loop", 
/**
 * Whether to.
 */
on: boolean, } | { "do": "abort" } | { "do": "stop_all" } | { "do": "dismiss_failure" } | { "do": "refresh" } | { "do": "identify", 
/**
 * Its name.
 */
robot: string, } | { "do": "forget", 
/**
 * Its name.
 */
robot: string, } | { "do": "pin", 
/**
 * The pixel's id.
 */
pixel: number, 
/**
 * The only robot that may show it; null: any.
 */
robot: string | null, } | { "do": "open", 
/**
 * Its name there.
 */
name: string, } | { "do": "connect", 
/**
 * `mqtt://host:1883` or `mqtts://…`, several with commas between them; or `embedded`.
 */
address: string, 
/**
 * User name; null: that of the address, or none.
 */
user?: string | null, 
/**
 * Password; null: that of the address, else the kept one where address and user are the kept ones.
 */
password?: string | null, 
/**
 * The authority to trust for `mqtts://`: PEM text, or a file on the server's machine; null: the system's.
 */
ca?: string | null, 
/**
 * A certificate of our own for a broker that asks for one: PEM text, or a file on the server's machine.
 */
client_cert?: string | null, 
/**
 * Its key: PEM text, or a file on the server's machine; null: the kept one where the certificate is.
 */
client_key?: string | null, } | { "do": "disconnect" };

/**
 * What to do where there are fewer ready robots than pixels.
 */
export type Missing = "refuse" | "leave_out";

/**
 * The answer to a [`Request`].
 */
export type Answer = { 
/**
 * The request's number.
 */
id: number, 
/**
 * Whether it was done.
 */
ok: boolean, 
/**
 * Why not: one line for people, with a remedy.
 */
error: string | null, 
/**
 * A way to go on all the same.
 */
choice: Choice | null, };

/**
 * A way to go on after a refusal.
 */
export type Choice = { 
/**
 * What a button for it should say.
 */
label: string, 
/**
 * What to ask for instead.
 */
operation: Operation, };

/**
 * A show in the library.
 */
export type ShowEntry = { 
/**
 * Its name in the library: what `open` and `/api/shows/{name}` take.
 */
name: string, 
/**
 * What its author called it; may be empty.
 */
title: string, 
/**
 * How many frames it has.
 */
frames: number, 
/**
 * How many pixels its fullest frame has.
 */
pixels: number, 
/**
 * When it was last saved, milliseconds since 1970.
 */
modified_ms: number, 
/**
 * Its version, as `If-Match` takes it, with its quotes.
 */
etag: string, 
/**
 * Where it comes from.
 */
origin: ShowOrigin, 
/**
 * Only in the answer to a save of a read-only show: what this entry, which is new, is a copy of.
 */
copy_of: ShowOrigin | null, };

/**
 * Where a show of the library comes from. All but saved shows are read-only.
 */
export type ShowOrigin = "saved" | "example" | "start_file";

/**
 * The body of every HTTP answer that is not a success.
 */
export type Problem = { 
/**
 * One line for people: what is wrong, and what to do.
 */
error: string, };

/** The lists of `Robots` in the order of its binary message. */
export const ROBOT_COLUMNS = [
  ["x", Float32Array],
  ["y", Float32Array],
  ["planned_x", Float32Array],
  ["planned_y", Float32Array],
  ["goal_x", Float32Array],
  ["goal_y", Float32Array],
  ["colour", Uint32Array],
  ["status", Uint8Array],
] as const;

/** Every status, in the order `Robots.status` counts them. */
export const ROBOT_STATUSES: readonly RobotStatus[] = ["idle", "ready", "driving", "held", "lost", "cut", "faulty"];

/** Every format of show files; the first is our own. A written file gets the first of `endings`. */
export const FORMATS = [
  { name: "lightbots", program: "LightBots", endings: [".lightbots.json", ".lightbots"], mediaType: "application/json", carries: ["title", "floor_size", "no_go_areas", "robot_limits", "identity", "starts", "music", "durations", "easing", "chosen_robots"] },
  { name: "original", program: "the original LightBots", endings: [".json"], mediaType: "application/json", carries: [] },
] as const;

/** Name of a format, as in `/api/convert?to=`. */
export type FormatName = (typeof FORMATS)[number]['name'];

/** Longest file that the server reads, bytes. */
export const FILE_BYTES_MAX = 67108864;
