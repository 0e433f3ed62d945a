// Made from crates/api by `cargo run -p lightbots-api --example types`. Change it there.

/**
 * A message to a screen. `hello` is followed by `show`, `plan`, `incidents`, `fleet` and the last lines of the log.
 * Each of these is sent again after a change, `fleet` also without a change. `state` comes 20 times a second, each
 * after the binary message `Robots`. A screen acknowledges each `state` with `took`. While a screen has not
 * acknowledged several, it gets no more.
 */
export type ToScreen = { "type": "hello" } & Hello | { "type": "show" } & OpenShow | { "type": "plan" } & Plan | { "type": "fleet" } & Fleet | { "type": "state" } & State | { "type": "log" } & LogLine | { "type": "incidents" } & Incidents | { "type": "answer" } & Answer;

/**
 * A message from a screen on the WebSocket.
 */
export type FromScreen = { "type": "operate" } & Request | { "type": "took" };

/**
 * What a screen must know about the server.
 */
export type Hello = { 
/**
 * Version of the program.
 */
version: string, 
/**
 * Number of this screen: screens are counted in the order of their connections.
 */
screen: number, 
/**
 * Number of simulated robots that this server runs.
 */
simulated: number, 
/**
 * Whether the network can reach the server without TLS (`--plain-http`), so that others on the network can read
 * passwords.
 */
plain_http: boolean, };

/**
 * The show that is open on every screen.
 */
export type OpenShow = { 
/**
 * Number of the document's state, increased with every change.
 */
revision: number, 
/**
 * Name of the show in the library; null: no show is open.
 */
name: string | null, 
/**
 * Version of the show in the library, for `If-Match`; null: no show is open.
 */
etag: string | null, 
/**
 * Why the show cannot be saved under its name, for people: its file holds fields that the document lacks. null: the
 * show can be saved.
 */
read_only: string | null, 
/**
 * The document in the format `lightbots`; null: no show is open.
 */
document: unknown, };

/**
 * The plan of a show: assignment of pixels, paths, durations and issues.
 */
export type Plan = { 
/**
 * Revision of the open show that was planned; 0 for a check of another document.
 */
revision: number, 
/**
 * Whether the server is still planning that revision. While it is planning, the fields below are empty.
 */
planning: boolean, 
/**
 * Whether the show can be played.
 */
ok: boolean, 
/**
 * Duration of the show, seconds: transitions and air times.
 */
duration_s: number, 
/**
 * Lower bound on `duration_s`, seconds: the sum of the lower bounds of all transitions, and all air times.
 */
lower_bound_s: number, 
/**
 * Smallest distance between two centres, metres; null with fewer than two robots.
 */
closest_m: number | null, 
/**
 * Share of all moments, 0 to 1, at which any single robot could stop dead without a contact; 1 if not measured.
 */
stop_safe: number, 
/**
 * Duration of planning, milliseconds; 0 for a plan that the browser made.
 */
plan_ms: number, 
/**
 * Issues: first those of reading and checking the show, then those of planning.
 */
issues: Array<Issue>, 
/**
 * `transitions[k]` leads to frame `k`. Shorter than the list of frames if planning failed.
 */
transitions: Array<Transition>, };

/**
 * A request for a plan, to the module in the browser.
 */
export type PlanningRequest = { 
/**
 * A show in the format `lightbots`.
 */
show: unknown, 
/**
 * With `quick`, stop-safety is neither improved nor measured. Paths are proven to be free of contact with either
 * quality.
 */
quality: MakeQuality, };

/**
 * A plan by the module in the browser, or why there is none.
 */
export type PlanAnswer = { 
/**
 * The plan. With quality `quick`, `stop_safe` of the plan is not measured and is 1. null: there is no plan.
 */
plan: Plan | null, 
/**
 * Why there is no plan; null: there is one.
 */
error: MakeRemark | null, };

/**
 * A request for the light of a planned show, to the module in the browser.
 */
export type LightRequest = { 
/**
 * A show in the format `lightbots`.
 */
show: unknown, 
/**
 * The drives to the frames of the show, with paths. In a frame without a drive, robots stand on the frame's pixels.
 */
transitions: Array<Transition>, };

/**
 * The answer to a [`LightRequest`].
 */
export type LightAnswer = { 
/**
 * Number of robots that colours are given for.
 */
robots: number, 
/**
 * Why there are no colours; null: there are colours.
 */
error: MakeRemark | null, };

/**
 * The transition to one frame.
 */
export type Transition = { 
/**
 * The frame before, counted from 0; null: the transition begins at the starting places.
 */
from: number | null, 
/**
 * The frame that the transition leads to, counted from 0.
 */
to: number, 
/**
 * Duration, seconds.
 */
duration_s: number, 
/**
 * Shortest duration that the robots' limits allow on these paths, seconds.
 */
least_s: number, 
/**
 * Lower bound on the duration, seconds: bottleneck distance divided by top speed.
 */
lower_bound_s: number, 
/**
 * Smallest distance between two centres, metres; null with fewer than two robots.
 */
closest_m: number | null, 
/**
 * Share of the transition's moments, 0 to 1, at which any single robot could stop dead without a contact; 1 if not
 * measured.
 */
stop_safe: number, 
/**
 * `pixels[robot]` is the id of the pixel that the robot shows after the transition; null: the robot stands by. The
 * list is empty in messages on the WebSocket; answers over HTTP have it.
 */
pixels: Array<number | null>, 
/**
 * `paths[robot]` is the path of the robot, which lasts `duration_s`. The list is empty in messages on the WebSocket;
 * answers over HTTP have it.
 */
paths: Array<Path>, };

/**
 * A timed path: cubic Bézier pieces whose parameter is proportional to time.
 */
export type Path = { 
/**
 * Start: x and y, stage metres.
 */
start: [number, number], 
/**
 * `[seconds, c1x, c1y, c2x, c2y, end x, end y]`: duration, two control points and end, stage metres. A piece
 * starts at the end of the piece before.
 */
pieces: Array<[number, number, number, number, number, number, number]>, };

/**
 * A fault or a note about a show or its plan.
 */
export type Issue = { 
/**
 * Kind of issue for programs, such as `pixel-off-floor`.
 */
code: string, 
/**
 * Severity.
 */
severity: Severity, 
/**
 * Index of the frame, counted from 0; null: the issue concerns the whole show.
 */
frame: number | null, 
/**
 * Ids of the pixels concerned; may be empty.
 */
pixels: Array<number>, 
/**
 * One line for people with place, cause and remedy. The text counts frames from 1.
 */
message: string, };

/**
 * Severity of an issue.
 */
export type Severity = "note" | "warning" | "error";

/**
 * The fleet table. It is sent at once when a robot is added or removed, and otherwise at most twice a second.
 */
export type Fleet = { 
/**
 * Number of the table, increased when a robot is added or removed. `State.fleet` names the table of a snapshot.
 */
revision: number, 
/**
 * Whether only listed robots take part in runs.
 */
only_listed: boolean, 
/**
 * One row per robot, in the order of `Robots`.
 */
rows: Array<FleetRow>, };

/**
 * A row of the fleet table.
 */
export type FleetRow = { 
/**
 * Name of the robot in messages, usually a UUID.
 */
id: string, 
/**
 * The status of the robot's last report; `idle` for an original robot, whose reports have none.
 */
status: RobotStatus, 
/**
 * How recent the last report is.
 */
presence: Presence, 
/**
 * Age of the last message from the robot, seconds.
 */
age_s: number, 
/**
 * Battery charge, percent; null: not reported.
 */
battery: number | null, 
/**
 * Time until the battery is empty at the measured slope, seconds; null: no slope is known yet.
 */
battery_left_s: number | null, 
/**
 * Id of the pixel that the robot shows or drives to, or showed at the end of its last run; null: none.
 */
pixel: number | null, 
/**
 * Name and version of the firmware; null: not reported. Original robots report none.
 */
firmware: string | null, 
/**
 * Abilities beyond the original protocol.
 */
abilities: Abilities, 
/**
 * Error of the robot's show clock, 2 sigma, microseconds; null: not synchronised.
 */
clock_us: number | null, 
/**
 * Name that people gave the robot; null: none.
 */
called: string | null, 
/**
 * Whether the robot may take part in runs.
 */
admitted: boolean, 
/**
 * Whether the robot reports that it is simulated. Without such a report, the robot counts as real.
 */
simulated: boolean, 
/**
 * Result of the last preflight for the robot; null: the robot was not tested, or a preflight is under way.
 */
preflight: PreflightResult | null, };

/**
 * The result of a preflight for one robot.
 */
export type PreflightResult = { 
/**
 * What is wrong with the robot; empty: the robot passed.
 */
faults: Array<PreflightFault>, 
/**
 * Largest distance between the robot and the planned end of a drive, measured after each drive of the preflight,
 * millimetres; null: not measured.
 */
off_mm: number | null, 
/**
 * Largest measured error of the robot's heading after a drive of the preflight, degrees; null: not measured.
 */
off_deg: number | null, 
/**
 * Whether Stop, heading and blinking were not tested, because the robot understands only the commands TARGET and
 * COLOR.
 */
limited: boolean, };

/**
 * Something wrong with a robot.
 */
export type PreflightFault = { 
/**
 * The fault, for people: a sentence whose subject is the robot, without a full stop.
 */
cause: string, 
/**
 * What to do about it: a sentence.
 */
remedy: string, };

/**
 * What a robot does. A number in `Robots.status` is an index into these values, counted from 0.
 */
export type RobotStatus = "idle" | "ready" | "driving" | "held" | "lost" | "cut" | "faulty";

/**
 * How recent the last report of a robot is.
 */
export type Presence = "active" | "stale" | "gone";

/**
 * Abilities of a robot beyond TARGET, COLOR and UUID.
 */
export type Abilities = { 
/**
 * The robot follows timed paths.
 */
route: boolean, 
/**
 * The robot fades its light.
 */
fade: boolean, 
/**
 * The robot blinks on request, so that people find it.
 */
blink: boolean, };

/**
 * A snapshot of the run. The binary message `Robots`, sent just before, has the places of the robots.
 */
export type State = { 
/**
 * The show clock, milliseconds.
 */
at_ms: number, 
/**
 * Rate of the show clock: 1 is real time. Less than 1 if the machine is too slow for its simulated robots.
 */
pace: number, 
/**
 * `Fleet.revision` of the fleet table that names the robots of the preceding binary message.
 */
fleet: number, 
/**
 * The broker.
 */
broker: Broker, 
/**
 * The run and its progress.
 */
playback: Playback, 
/**
 * Position of the show on its timeline at `at_ms`; null: no show is played, or its first drive has not begun.
 */
show_time: ShowTime | null, };

/**
 * The connection to the broker.
 */
export type Broker = { 
/**
 * Addresses of the broker without user and password, separated by commas; empty: no broker is wanted.
 */
address: string, 
/**
 * Phase of the connection.
 */
phase: BrokerPhase, 
/**
 * Whether the broker answers: `phase` is `connected`.
 */
connected: boolean, 
/**
 * The address in use; null: none.
 */
node: string | null, 
/**
 * Why the broker does not answer: one line for people with cause, place and remedy; null unless `phase` is
 * `retrying`.
 */
reason: string | null, };

/**
 * Phase of the connection to the broker.
 */
export type BrokerPhase = "off" | "connecting" | "connected" | "retrying";

/**
 * The kept broker settings, for a form. Passwords and keys never leave the server.
 */
export type BrokerSettings = { 
/**
 * Addresses of the broker in use or used last, without login, separated by commas; or `embedded`.
 */
address: string, 
/**
 * User name; null: no user name is kept.
 */
user: string | null, 
/**
 * Whether the server keeps a password for that user.
 */
has_password: boolean, 
/**
 * Certificate authority to trust: PEM text or the path of a file on the server; null: those of the system.
 */
ca: string | null, 
/**
 * Client certificate for the broker: PEM text or the path of a file on the server; null: none.
 */
client_cert: string | null, 
/**
 * Whether the server keeps the key of the client certificate.
 */
has_client_key: boolean, 
/**
 * Address of the server's own broker; null: the server runs none and refuses `embedded`.
 */
embedded: string | null, };

/**
 * The run: what is played, and how far it is.
 */
export type Playback = { 
/**
 * Phase of the run.
 */
phase: Phase, 
/**
 * What the run does, for people, such as `driving`; null: there is no run.
 */
doing: string | null, 
/**
 * Index of the frame that robots show or drive to, counted from 0. null: there is no run, or it is a preflight or
 * a drive to the starting places.
 */
frame: number | null, 
/**
 * Index of the frame after `frame`, counted from 0; null: `frame` is null, or the run ends after `frame`.
 */
next: number | null, 
/**
 * Whether `GoTo` and `Skip` are possible: a show is played, and robots stand or are held.
 */
may_jump: boolean, 
/**
 * Number of frames of the open show.
 */
frames: number, 
/**
 * Progress of the drive under way, 0 to 1; 1 during the air time and while the show waits for `go`, 0 without a
 * run.
 */
progress: number, 
/**
 * Planned time to the end of the show, or of its present pass if it begins again, seconds. On the drive
 * to the starting places: to the end of that drive. null: robots do neither, or frames repeat until `go`.
 */
left_s: number | null, 
/**
 * Why and where the last run failed, a sentence for people; null: no failure since the last run began, or
 * dismissed.
 */
failure: string | null, 
/**
 * Index of the frame in which the last run of a show ended early, counted from 0. null: the run reached its end,
 * another run began, another show was opened, or `dismiss_failure` cleared the index.
 */
stopped_in: number | null, 
/**
 * The preflight that is under way, or the last one since the server's start; null: there was none.
 */
preflight: PreflightState | null, 
/**
 * Name of the cue at which the show waits for `go`; may be empty. Null: the show does not wait for `go`.
 */
cue: string | null, 
/**
 * Names of the layers of live light that are on, lowest first.
 */
live_light: Array<string>, 
/**
 * The frames that repeat until `go`; null: no frames repeat at the moment.
 */
repeats: Repeats | null, 
/**
 * Whether `go_on` can continue a show whose robots were out of reach, because some of its robots report again.
 */
may_go_on: boolean, 
/**
 * Speed of drives of a show, of one frame and to the starting places, percent of the usual speed.
 */
speed_percent: number, 
/**
 * Whether robots of this kind (real or simulated) have never played the open show to its end. The screen then
 * offers a slow first run. `false` for a show without frames, and until the server knows the drives of the show.
 */
first_run: boolean, 
/**
 * Whether the show begins again after the last frame.
 */
looping: boolean, 
/**
 * Names of the robots that the fleet waits for: late on a drive, or not ready for one; at most 20.
 */
late: Array<string>, };

/**
 * The preflight that is under way, or the last one.
 */
export type PreflightState = { 
/**
 * What robots do, for people, such as `driving out`; null: the preflight is over.
 */
doing: string | null, 
/**
 * The round under way, counted from 1; 0: the preflight is over. Robots that would be in each other's way are
 * tested in different rounds.
 */
round: number, 
/**
 * Number of rounds; 0: the preflight is over.
 */
rounds: number, 
/**
 * Whether the preflight was carried out to its end.
 */
finished: boolean, 
/**
 * Number of robots that passed; 0 while the preflight is under way.
 */
passed: number, 
/**
 * Number of robots with faults; 0 while the preflight is under way.
 */
named: number, };

/**
 * Frames that repeat until `go`.
 */
export type Repeats = { 
/**
 * Index of the first repeated frame, counted from 0.
 */
first: number, 
/**
 * Index of the last repeated frame, counted from 0.
 */
last: number, 
/**
 * Number of the present round, counted from 1.
 */
round: number, 
/**
 * Whether GO was given. The show then goes on with the frame after `last`.
 */
leaves: boolean, };

/**
 * Position of the show on its timeline. In a show with music, this is the position of the music.
 */
export type ShowTime = { 
/**
 * Seconds from the start of the first frame's air time; negative during the drive to the first frame.
 */
show_s: number, 
/**
 * Whether the position advances with the show clock. With music, the position stands still during a pause and while
 * the show waits for GO. Without music, it also stands still while robots are held or waited for.
 */
runs: boolean, };

/**
 * Phase of the run.
 */
export type Phase = "idle" | "ready" | "preparing" | "playing" | "paused" | "preview" | "aborting" | "link_lost";

/**
 * Places, lights and statuses: every list has one entry per robot, in the order of the fleet table.
 */
export type Robots = { 
/**
 * Measured x, stage metres, rounded to 0.1 mm; NaN: unknown.
 */
x: Float32Array, 
/**
 * Measured y, stage metres, rounded to 0.1 mm; NaN: unknown.
 */
y: Float32Array, 
/**
 * Planned x now, stage metres; NaN: the robot drives no path now. A planned place is never drawn as a measured
 * one.
 */
planned_x: Float32Array, 
/**
 * Planned y now, stage metres; NaN: the robot drives no path now.
 */
planned_y: Float32Array, 
/**
 * x of the place where the robot is to stand after its present or last drive, stage metres; NaN: there was no
 * drive.
 */
goal_x: Float32Array, 
/**
 * y of the place where the robot is to stand after its present or last drive, stage metres; NaN: there was no
 * drive.
 */
goal_y: Float32Array, 
/**
 * Colour that the light should have: R·65536 + G·256 + B.
 */
colour: Uint32Array, 
/**
 * Index of the robot's `RobotStatus`, from 0.
 */
status: Uint8Array, };

/**
 * A line of the log.
 */
export type LogLine = { 
/**
 * Number of the line. A line with the number of an earlier line replaces that line.
 */
id: number, 
/**
 * Time of the event, milliseconds since 1970; of the first event if the line sums up several.
 */
time_ms: number, 
/**
 * Severity.
 */
level: Level, 
/**
 * Text for people, one line.
 */
text: string, 
/**
 * Number of robots if the line sums up events of at least two robots, else 0.
 */
count: number, 
/**
 * Names of the first of these robots.
 */
robots: Array<string>, };

/**
 * Severity of a line of the log.
 */
export type Level = "debug" | "info" | "warn" | "error";

/**
 * All incidents that are kept, oldest first.
 */
export type Incidents = { 
/**
 * The incidents.
 */
list: Array<Incident>, };

/**
 * Something that went wrong, what the program did about it, and what people can do.
 */
export type Incident = { 
/**
 * Number of the incident. It does not change when further events are added to the incident.
 */
id: number, 
/**
 * Time of the incident's first event, milliseconds since 1970.
 */
time_ms: number, 
/**
 * How much it matters.
 */
tone: IncidentTone, 
/**
 * What happened: robot, frame, cause. One sentence.
 */
title: string, 
/**
 * What the program did about the incident; may be empty.
 */
done: string, 
/**
 * What people can do.
 */
advice: string, 
/**
 * Names of the first robots concerned.
 */
robots: Array<string>, 
/**
 * Number of all robots concerned.
 */
count: number, 
/**
 * Whether the robots concerned are not admitted to runs yet; the operation `list` admits them.
 */
wants_to_join: boolean, 
/**
 * Whether the incident is over.
 */
over: boolean, 
/**
 * Whether the operator has read the incident.
 */
read: boolean, };

/**
 * How much an incident matters.
 */
export type IncidentTone = "information" | "look" | "failed";

/**
 * A numbered request.
 */
export type Request = { 
/**
 * Number of the request, chosen by the screen. The answer repeats it.
 */
id: number, 
/**
 * The operation.
 */
operation: Operation, };

/**
 * An operation on show, fleet or broker. Frames are counted from 0.
 */
export type Operation = { "do": "play", 
/**
 * The first frame that is shown.
 */
from: number, 
/**
 * What happens if robots are missing.
 */
missing: Missing, } | { "do": "preview", 
/**
 * The frame.
 */
frame: number, 
/**
 * What happens if robots are missing.
 */
missing?: Missing, } | { "do": "pause" } | { "do": "resume" } | { "do": "step" } | { "do": "go" } | { "do": "go_to", 
/**
 * The frame.
 */
frame: number, } | { "do": "skip" } | { "do": "live_light", 
/**
 * Name of the layer. A layer that already has this name is replaced.
 */
name: string, 
/**
 * The layer, as in a show file (docs/light.md); the layer's span of time is ignored. Null: take the layer off.
 */
layer: Record<string, unknown> | null, } | { "do": "loop", 
/**
 * Whether the show begins again.
 */
on: boolean, } | { "do": "speed", 
/**
 * Percent of the usual speed.
 */
percent: number, } | { "do": "home" } | { "do": "preflight" } | { "do": "abort" } | { "do": "stop_all" } | { "do": "go_on" } | { "do": "dismiss_failure" } | { "do": "read_incident", 
/**
 * Number of the incident.
 */
incident: number, } | { "do": "refresh" } | { "do": "identify", 
/**
 * Name of the robot.
 */
robot: string, } | { "do": "forget", 
/**
 * Name of the robot.
 */
robot: string, } | { "do": "call", 
/**
 * Name of the robot in messages.
 */
robot: string, 
/**
 * The name, at most 40 characters; empty: take the name away.
 */
called: string, } | { "do": "only_listed", 
/**
 * Whether only listed robots take part.
 */
on: boolean, } | { "do": "list", 
/**
 * Names of the robots in messages.
 */
robots: Array<string>, 
/**
 * Whether they are listed.
 */
listed: boolean, } | { "do": "pin", 
/**
 * Id of the pixel.
 */
pixel: number, 
/**
 * Name of the only robot that may show the pixel; null: any robot may.
 */
robot: string | null, } | { "do": "open", 
/**
 * Name of the show in the library.
 */
name: string, } | { "do": "connect", 
/**
 * `mqtt://host:1883` or `mqtts://…`, several separated by commas; or `embedded`.
 */
address: string, 
/**
 * User name; null: the user in the address, if there is one.
 */
user?: string | null, 
/**
 * Password; null: the password in the address. If the address has none: the kept password, provided that
 * address and user are the kept ones.
 */
password?: string | null, 
/**
 * Certificate authority to trust: PEM text or the path of a file on the server; null: those of the system.
 */
ca?: string | null, 
/**
 * Client certificate for a broker that asks for one: PEM text or the path of a file on the server.
 */
client_cert?: string | null, 
/**
 * Key of the client certificate: PEM text or the path of a file on the server. null: the kept key, provided
 * that `client_cert` is the kept certificate.
 */
client_key?: string | null, } | { "do": "disconnect" };

/**
 * What happens if there are fewer ready robots than pixels, or the robot of a pinned pixel is not ready.
 */
export type Missing = "refuse" | "leave_out";

/**
 * The answer to a [`Request`].
 */
export type Answer = { 
/**
 * Number of the request.
 */
id: number, 
/**
 * Whether the operation was carried out.
 */
ok: boolean, 
/**
 * Why the operation was refused: one line for people with cause and remedy; null if `ok`.
 */
error: string | null, 
/**
 * Another operation that the server would carry out instead; null: none.
 */
choice: Choice | null, };

/**
 * An operation that the server offers after a refusal.
 */
export type Choice = { 
/**
 * Label of a button for the operation.
 */
label: string, 
/**
 * The operation.
 */
operation: Operation, };

/**
 * A show in the library.
 */
export type ShowEntry = { 
/**
 * Name in the library, for `open` and `/api/shows/{name}`.
 */
name: string, 
/**
 * Name that the author gave the show; may be empty.
 */
title: string, 
/**
 * Number of frames.
 */
frames: number, 
/**
 * Number of pixels of the largest frame.
 */
pixels: number, 
/**
 * Time of the last save, milliseconds since 1970; 0 unless `origin` is `saved`.
 */
modified_ms: number, 
/**
 * Version of the document with its quotes, for `If-Match`.
 */
etag: string, 
/**
 * Where the show comes from.
 */
origin: ShowOrigin, 
/**
 * Why the show cannot be saved under its name, for people: its file holds fields that this version does not know.
 * null: the show can be saved, or is read-only because of `origin`.
 */
read_only: string | null, 
/**
 * Origin of the example or start file of which this new entry is a copy. Only in the answer to a save under the
 * name of an example or the start file; otherwise null.
 */
copy_of: ShowOrigin | null, 
/**
 * Issues found in the file, such as contents that a show cannot hold. Only in the answer to a save.
 */
issues: Array<Issue>, };

/**
 * Where a show of the library comes from. Only saved shows can be changed.
 */
export type ShowOrigin = "saved" | "example" | "start_file";

/**
 * A saved state of a show.
 */
export type ShowState = { 
/**
 * Number for `/api/shows/{name}/states/{number}`; null: the current state.
 */
number: number | null, 
/**
 * Time of the save, milliseconds since 1970; 0 for an example or the start file.
 */
saved_ms: number, 
/**
 * Name that the author gave the show; may be empty.
 */
title: string, 
/**
 * Number of frames.
 */
frames: number, 
/**
 * Number of pixels of the largest frame.
 */
pixels: number, 
/**
 * Version of the file, with its quotes. States with equal versions have equal content.
 */
etag: string, };

/**
 * A recorded run.
 */
export type RunEntry = { 
/**
 * Number for `/api/runs/{number}/report`.
 */
number: number, 
/**
 * What robots did.
 */
kind: RunEntryKind, 
/**
 * Name that the author gave the show; may be empty.
 */
show: string, 
/**
 * When it began, milliseconds since 1970.
 */
began_ms: number, 
/**
 * When the run ended, milliseconds since 1970; null: the run is still on, or the program ended before the run did.
 */
ended_ms: number | null, 
/**
 * Whether the run reached its end, all its frames were shown, and no robot was missing at the end. `false` while
 * the run is on.
 */
ok: boolean, 
/**
 * How the run ended, in one sentence; null: the run is still on, or the program ended before the run did.
 */
outcome: string | null, 
/**
 * Whether the report of the run can be made.
 */
has_report: boolean, };

/**
 * What robots did in a run.
 */
export type RunEntryKind = "show" | "frame" | "home";

/**
 * The body of an HTTP answer that refuses a request.
 */
export type Problem = { 
/**
 * One line for people: cause and remedy.
 */
error: string, };

/**
 * A new playlist from a client.
 */
export type PlaylistChange = { 
/**
 * `PlaylistState.revision` of the playlist that this new playlist replaces.
 */
revision: number, 
/**
 * Whether shows start by themselves. The server keeps the setting over restarts of the program.
 */
on: boolean, 
/**
 * The entries in order.
 */
entries: Array<PlaylistEntry>, };

/**
 * A show of a playlist. Either it starts at a time of day (`at`), or `pause_min` after the previous entry has ended.
 */
export type PlaylistEntry = { 
/**
 * Number of the entry, given by the server; 0 or left out: a new entry.
 */
id?: number, 
/**
 * Name of the show in the library.
 */
show: string, 
/**
 * Time of day at which the entry starts, `HH:MM`, local time of the server; null: it follows the previous entry.
 */
at?: string | null, 
/**
 * Days on which an entry with `at` is played; empty: every day.
 */
weekdays?: Array<PlaylistDay>, 
/**
 * Minutes from the end of the previous entry to the start of this entry; null: this entry has a time of day.
 */
pause_min?: number | null, 
/**
 * Whether robots drive to their starting places at the beginning of the pause. Only for an entry with `pause_min`.
 */
home?: boolean, 
/**
 * Speed of drives, percent of the usual speed.
 */
speed_percent: number, };

/**
 * A day of the week.
 */
export type PlaylistDay = "mon" | "tue" | "wed" | "thu" | "fri" | "sat" | "sun";

/**
 * The current playlist.
 */
export type PlaylistState = { 
/**
 * Number of the playlist's version, increased with each change of `on` or `entries`.
 */
revision: number, 
/**
 * Whether shows start by themselves.
 */
on: boolean, 
/**
 * The entries in order.
 */
entries: Array<PlaylistEntry>, 
/**
 * What became of each entry today, in the order of `entries`.
 */
today: Array<PlaylistToday>, 
/**
 * The entry that starts next; null: none within a week, or none until the present entry is over. If the playlist
 * is off: the entry that would start next if it were switched on.
 */
next: PlaylistNext | null, 
/**
 * Why the playlist is held and starts no show, one sentence: a person stopped robots. null: the playlist is not
 * held. The operation `go_on` lets it continue.
 */
held: string | null, 
/**
 * Why the playlist's file cannot be read, with file, place and remedy: nothing is played meanwhile. null: the file can
 * be read.
 */
fault: string | null, 
/**
 * Local time of day of the server, `HH:MM`.
 */
now: string, };

/**
 * What became of an entry today.
 */
export type PlaylistToday = { 
/**
 * What became of the entry.
 */
result: PlaylistResult, 
/**
 * Local time of day of the server, `HH:MM`, at which the entry starts, began or ended. null: not known yet, or
 * `result` is `not_today` or `past`.
 */
time: string | null, 
/**
 * Why the entry failed or was skipped, with a remedy: one line; null: neither happened.
 */
line: string | null, };

/**
 * What may become of an entry on a day.
 */
export type PlaylistResult = "not_today" | "waiting" | "past" | "playing" | "played" | "failed" | "skipped";

/**
 * The entry that starts next.
 */
export type PlaylistNext = { 
/**
 * Number of the entry.
 */
id: number, 
/**
 * Name of its show.
 */
show: string, 
/**
 * Local time of the server, such as `19:00` or `Fri 19:00`.
 */
time: string, 
/**
 * Time until the entry starts, seconds; 0: it is due.
 */
in_s: number, };

/**
 * The refusal of an operation that came over HTTP.
 */
export type RefusedOperation = { 
/**
 * Why the operation was refused: one line for people with cause and remedy.
 */
error: string, 
/**
 * Another operation that the server would carry out instead; null: none.
 */
choice: Choice | null, };

/**
 * What a person or a program may do. A greater role may do all that a smaller one may.
 */
export type AccountRole = "viewer" | "editor" | "operator";

/**
 * The person or program that sent a request.
 */
export type Whoami = { 
/**
 * Name of the person or the token; null on loopback, where no sign-in is needed.
 */
name: string | null, 
/**
 * The role of the person or the token now.
 */
role: AccountRole, };

/**
 * A person or a token.
 */
export type AccountEntry = { 
/**
 * Name: 1 to 32 letters, digits and `-` `_` `.`.
 */
name: string, 
/**
 * What the person or the token may do.
 */
role: AccountRole, };

/**
 * A new token of a program.
 */
export type MadeToken = { 
/**
 * Name of the token.
 */
name: string, 
/**
 * What the token may do. A token never allows more than the present role of the person that made the token.
 */
role: AccountRole, 
/**
 * The token itself, for the header `Authorization: Bearer TOKEN`. The server keeps only a hash of it.
 */
token: string, };

/**
 * A person to be added.
 */
export type NewPerson = { 
/**
 * Name: 1 to 32 letters, digits and `-` `_` `.`.
 */
name: string, 
/**
 * What the person may do.
 */
role: AccountRole, 
/**
 * Password of the person: at least 8 characters, at most 256 bytes.
 */
password: string, };

/**
 * A change of the role or password of a person.
 */
export type PersonChange = { 
/**
 * The new role; null: as before.
 */
role?: AccountRole | null, 
/**
 * The new password, which ends the sessions of the person; null: as before.
 */
password?: string | null, };

/**
 * Name and password of a person.
 */
export type Credentials = { 
/**
 * Name of the person.
 */
name: string, 
/**
 * Password of the person.
 */
password: string, };

/**
 * The first operator, with the one-time token that the program printed when it started without people.
 */
export type FirstOperator = { 
/**
 * The one-time token.
 */
token: string, 
/**
 * Name of the operator: 1 to 32 letters, digits and `-` `_` `.`.
 */
name: string, 
/**
 * Password of the operator: at least 8 characters, at most 256 bytes.
 */
password: string, };

/**
 * A request to make a frame from its source.
 */
export type MakeRequest = { 
/**
 * A show in the format `lightbots`. Only its stage and its first frame, which has the source, are used. Pixels of that
 * frame that were moved by hand keep their places.
 */
show: unknown, 
/**
 * Number of robots.
 */
robots: number, 
/**
 * How much work is put into the frame.
 */
quality: MakeQuality, };

/**
 * How much work is put into a result.
 */
export type MakeQuality = "quick" | "full";

/**
 * A made frame, or why there is none.
 */
export type MakeAnswer = { 
/**
 * The pixels with their ids; empty if there is an error.
 */
pixels: Array<MadePixel>, 
/**
 * Longer side of the picture, metres.
 */
size_m: number, 
/**
 * Distance of the closest two pixels, metres; null with fewer than two pixels.
 */
closest_m: number | null, 
/**
 * How well the lights show the source; null: the source is itself an arrangement of lights, such as a grid.
 */
readability: MadeReadability | null, 
/**
 * Number of robots with which the source would be readable, determined only for a `full` result that is not
 * readable. null: not determined, or a thousand robots are not enough.
 */
enough: number | null, 
/**
 * What is missing from the picture, or differs from the request.
 */
notes: Array<MakeRemark>, 
/**
 * Why there is no picture; null: there is one.
 */
error: MakeRemark | null, };

/**
 * A pixel of a made frame.
 */
export type MadePixel = { 
/**
 * Id, unique in its frame.
 */
id: number, 
/**
 * x and y, stage metres.
 */
place: [number, number], 
/**
 * Colour as red, green and blue, such as `#ffa500`.
 */
color: string, 
/**
 * The robot that is pinned to the pixel; null: any robot.
 */
robot: string | null, 
/**
 * Name of the source's part, such as a letter; may be empty. null: the pixel belongs to no source.
 */
part: string | null, };

/**
 * How well the lights of a frame show the frame's source.
 */
export type MadeReadability = { 
/**
 * Normalised cross-correlation of the blurred lights with the source, 0 to 1. A source of several parts, such as
 * letters, gets the lowest value of its parts.
 */
correlation: number, 
/**
 * Share of the lights that have a mirror image, 0 to 1, if the source is mirror-symmetric; 1 for other sources.
 */
symmetry: number, 
/**
 * Whether `correlation` is high enough for viewers to recognise the picture without being told what it is.
 */
readable: boolean, };

/**
 * A note or an error: a word for programs and a sentence for people.
 */
export type MakeRemark = { 
/**
 * Kind for programs, such as `too-many-robots`.
 */
code: string, 
/**
 * One line for people: what is wrong, where, and the remedy.
 */
message: string, };

/**
 * Beats that were found in music.
 */
export type BeatsAnswer = { 
/**
 * Tempo, beats a minute.
 */
bpm: number, 
/**
 * Time of the first beat, seconds from the start of the music file, if the tempo is constant; null: `times_s` has
 * each beat.
 */
offset_s: number | null, 
/**
 * Times of all beats, seconds from the start of the music file, increasing; empty if the tempo is constant.
 */
times_s: Array<number>, 
/**
 * Why no beats were found, and what to do; null: beats were found.
 */
error: MakeRemark | null, };

/**
 * The frames that an animation becomes, or why there are none.
 */
export type FilmAnswer = { 
/**
 * The frames in order of time; empty if there is an error.
 */
frames: Array<FilmPicture>, 
/**
 * Factor by which the animation is slowed down, so that robots have time to move; 1: it is not slowed down.
 */
slowdown: number, 
/**
 * What is missing from the frames, or differs from the animation.
 */
notes: Array<MakeRemark>, 
/**
 * Why there are no frames; null: there are frames.
 */
error: MakeRemark | null, };

/**
 * A frame that shows a moment of an animation.
 */
export type FilmPicture = { 
/**
 * The moment, seconds from the start of the animation.
 */
moment_s: number, 
/**
 * How long the picture stays, seconds.
 */
air_time_s: number, 
/**
 * The frame's pixels.
 */
made: MakeAnswer, };

/**
 * A show whose frames were all fitted to the same number of robots, or why there is none.
 */
export type FitAnswer = { 
/**
 * The show in the format `lightbots`; null if there is an error.
 */
show: unknown, 
/**
 * Changes to the show that people may not expect, such as lost starting places.
 */
notes: Array<MakeRemark>, 
/**
 * Why there is no show; null: there is one.
 */
error: MakeRemark | null, };

/**
 * Fonts and shapes that the settings of sources may name.
 */
export type MakeChoices = { 
/**
 * Built-in fonts, in the order in which they are offered.
 */
fonts: Array<MakeFont>, 
/**
 * All shapes with their usual settings.
 */
shapes: Array<MakeShape>, };

/**
 * A built-in font.
 */
export type MakeFont = { 
/**
 * Name in settings.
 */
name: string, 
/**
 * Name for people.
 */
title: string, };

/**
 * A shape with its usual settings; each shape uses some of them.
 */
export type MakeShape = { 
/**
 * Name in settings.
 */
name: string, 
/**
 * Width over height.
 */
aspect: number, 
/**
 * Number of corners, tips or circles.
 */
count: number, 
/**
 * Turns of a spiral, or periods of a wave.
 */
turns: number, 
/**
 * Inner radius as a share of the outer radius.
 */
inner: number, 
/**
 * Angle of an arc, radians.
 */
span: number, };

/**
 * A file that was dropped or chosen.
 */
export type MakeFile = { 
/**
 * SHA-256 of the file's bytes as 64 hexadecimal digits.
 */
hash: string, 
/**
 * What the file can be used for. `svg`, `picture`, `list` or `animation`: source of a frame; `font`: font of
 * words; `show`: a show; `music`: music of a show. null: the file cannot be used.
 */
kind: string | null, 
/**
 * Why the file cannot be used, and what to do; null: the file can be used.
 */
error: MakeRemark | null, };

/**
 * Where the pixels of a picture are after a motion.
 */
export type MovedAnswer = { 
/**
 * The pixels with their ids; empty if there is an error.
 */
pixels: Array<MovedPixel>, 
/**
 * Why there are no pixels; null: there are pixels.
 */
error: MakeRemark | null, };

/**
 * A pixel after a motion.
 */
export type MovedPixel = { 
/**
 * Id, as in the picture before.
 */
id: number, 
/**
 * x and y, stage metres.
 */
place: [number, number], };

/** The lists of `Robots` in the order of the binary message. */
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

/** Every status, at the index that `Robots.status` holds. */
export const ROBOT_STATUSES: readonly RobotStatus[] = ["idle", "ready", "driving", "held", "lost", "cut", "faulty"];

/** Every format of show files; the first is our own. A written file gets the first of `endings`. */
export const FORMATS = [
  { name: "lightbots", program: "LightBots", endings: [".lightbots.json", ".lightbots"], mediaType: "application/json", carries: ["title", "floor_size", "no_go_areas", "robot_limits", "identity", "starts", "music", "durations", "easing", "chosen_robots", "sources", "groups", "layers", "absolute_times", "marks", "cues", "motions", "trajectories", "spares", "assets"] },
  { name: "archive", program: "LightBots, with its files", endings: [".lightbots.zip"], mediaType: "application/zip", carries: ["title", "floor_size", "no_go_areas", "robot_limits", "identity", "starts", "music", "durations", "easing", "chosen_robots", "sources", "groups", "layers", "absolute_times", "marks", "cues", "motions", "trajectories", "spares", "assets", "asset_files"] },
  { name: "original", program: "the original LightBots", endings: [".json"], mediaType: "application/json", carries: [] },
  { name: "skyc", program: "Skybrush", endings: [".skyc"], mediaType: "application/skybrush-compiled", carries: ["title", "identity", "starts", "durations", "easing", "trajectories", "plan", "music", "chosen_robots"] },
  { name: "csv", program: "Skybrush, as tables", endings: [".csv.zip"], mediaType: "application/zip", carries: ["identity", "starts", "durations", "easing", "chosen_robots", "plan"] },
  { name: "vviz", program: "Finale 3D and other VVIZ programs", endings: [".vviz"], mediaType: "application/json", carries: ["title", "identity", "starts", "durations", "easing", "trajectories", "plan"] },
  { name: "fseq", program: "xLights and the Falcon Player", endings: [".fseq"], mediaType: "application/x-fseq", carries: ["music"] },
] as const;

/** Name of a format, as in `/api/convert?to=`. */
export type FormatName = (typeof FORMATS)[number]['name'];

/** Longest file that the server reads, bytes. */
export const FILE_BYTES_MAX = 67108864;
