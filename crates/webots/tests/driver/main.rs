//! Whole shows with the real driver: one process per robot on the stand-in, as in Webots, with a real broker and the
//! real controller.

mod eyes;
mod floor;
mod lead;
mod login;
mod pace;
mod paces;
mod processes;
mod rays;
mod tape;

use std::path::Path;
use std::process::{Command, Stdio};

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use floor::{Account, Floor, STEPS_A_PLACE};
use lightbots_base::{RobotId, Span, Vec2};
use lightbots_exchange::{Format, LIGHTBOTS, ORIGINAL, for_file};
use lightbots_show::{Show, Stage};
use lightbots_sim::STEP;
use pace::Pace;
use processes::{Running, built, mosquitto, stand_in};
use tape::{Score, Tape};

/// Held while a show is played, because two at once would overload the machine.
pub static TURN: Mutex<()> = Mutex::new(());

/// The show in a file of `shows/`, cut to its first `frames`.
fn show(file: &str, frames: usize) -> Show {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shows").join(file);
    let bytes = std::fs::read(path).expect("the show is there");
    let mut show = lightbots_exchange::read(&bytes, Some(file)).expect("the show can be read").show;
    show.frames.truncate(frames);
    show
}

/// The name of a robot. Numbers begin at 1, as in the worlds.
fn id(number: usize) -> RobotId {
    RobotId::new(&format!("robot-{number}")).expect("a name")
}

/// Plays a show with one driver per pixel. Returns the controller's report, the results of the floor and the record of
/// the broker's messages.
fn play(show: &Show, format: &Format, pace: Pace) -> (serde_json::Value, Account, Score) {
    let count = show.frames[0].pixels.len();
    let starts = lightbots_show::back_rows(&show.stage, count);
    let folder = tempfile(&show.name);
    let path = folder.join(format!("show{}", format.ending()));
    std::fs::write(&path, format.write(show, None).bytes).expect("the temporary folder can be written");
    let socket = folder.join("floor");
    let floor = Floor::open(&socket, &show.stage, &starts, count, (pace, 1));
    let (_broker, port) = mosquitto();
    let broker = format!("mqtt://127.0.0.1:{port}");
    let tape = Tape::record(&broker);
    let drivers: Vec<Running> = (1..=count).map(|number| driver(number, &broker, &socket, &[])).collect();
    let output = Command::new(built("lightbots"))
        .arg("play")
        .arg(&path)
        .args(["--broker", &broker, "--wait", &count.to_string(), "--json"])
        .stderr(Stdio::inherit())
        .output()
        .expect("the controller starts");
    let account = floor.close();
    let score = tape.end();
    for mut driver in drivers {
        ends_well(&mut driver);
    }
    let _ = std::fs::remove_dir_all(&folder);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let report = serde_json::from_str(&text).unwrap_or_else(|error| panic!("no report ({error}): {text}"));
    (report, account, score)
}

/// Starts the driver of robot `LightBot number` on a floor.
fn driver(number: usize, broker: &str, socket: &Path, more: &[&str]) -> Running {
    Running(driver_command(number, broker, socket).args(more).spawn().expect("the driver starts"))
}

/// The command that starts a driver.
fn driver_command(number: usize, broker: &str, socket: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_LightBotFirmware"));
    command
        .args(["--broker", broker, "--id", id(number).as_str()])
        .env("WEBOTS_ROBOT_NAME", format!("LightBot {number}"))
        .env("LIGHTBOTS_STANDIN", socket)
        .env("LD_LIBRARY_PATH", stand_in().parent().expect("it lies in a folder"));
    command
}

fn tempfile(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("lightbots-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
    folder
}

/// Plays a show at Webots' usual pace and checks it. Returns the robots' tracks, `[robot][sample]`.
fn plays_without_contact(show: &Show, format: &Format) -> Vec<Vec<(Instant, Vec2)>> {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let (report, account, score) = play(show, format, Pace::WEBOTS);
    let Account { contacts, closest_m, places, colours, .. } = &account;
    assert_eq!(report["ok"], true, "{report:#}");
    assert_eq!(report["frames_played"], show.frames.len(), "{report:#}");
    assert_eq!(*contacts, 0, "the closest were {closest_m:?} m apart");
    assert!(closest_m.is_some_and(|closest_m| closest_m > 0.054), "{closest_m:?}");
    let last = show.frames.last().expect("a show has frames");
    for pixel in &last.pixels {
        let nearest = places.iter().map(|at| at.distance(pixel.at)).fold(f64::INFINITY, f64::min);
        assert!(nearest <= 0.02, "nobody stands on pixel {}: {nearest} m", pixel.id);
    }
    assert!(colours.iter().any(|colour| *colour != 0), "no light is on");
    keeps_to_its_routes(show, &score, &account);
    account.tracks
}

/// Largest distances of robots from the lines of their routes, and from their due places, metres.
fn off_m(score: &Score, account: &Account) -> (f64, f64) {
    let off = account.tracks.iter().enumerate();
    let off = off.map(|(index, track)| score.furthest_off_m(id(index + 1), track));
    off.fold((0.0, 0.0), |worst: (f64, f64), (beside_m, timed_m)| {
        (worst.0.max(beside_m), worst.1.max(timed_m))
    })
}

/// Checks that robots were on the plan's routes during the whole show, and that none braked for a neighbour.
#[allow(clippy::print_stdout)]
fn keeps_to_its_routes(show: &Show, score: &Score, account: &Account) {
    let (beside_m, timed_m) = off_m(score, account);
    println!(
        "{}: at most {:.1} mm beside the routes, {:.1} mm from where they were due, at {:.3} x real time",
        show.name,
        beside_m * 1e3,
        timed_m * 1e3,
        account.rate
    );
    assert_eq!(score.blocked(), &[] as &[String]);
    assert_eq!(score.holds(), (0, 0), "the fleet waited for a robot");
    assert!(beside_m > 0.0 && beside_m <= 0.005, "a robot was {:.1} mm beside its route", beside_m * 1e3);
}

/// Largest distance of a robot from its path to the first picture in the plan of a rehearsal, metres. Planner and
/// starts are the same. Later plans may differ, because the controller starts from the places that robots report.
fn furthest_off(show: &Show, tracks: &[Vec<(Instant, Vec2)>]) -> f64 {
    let starts = lightbots_show::back_rows(&show.stage, tracks.len());
    let plan = lightbots_plan::show(show, &starts, &lightbots_plan::ShowOptions::default());
    let first = &plan.transitions[0];
    let mut furthest = 0.0_f64;
    for (path, track) in first.paths.iter().zip(tracks) {
        let path = path.as_ref();
        let way: Vec<Vec2> =
            (0..=first.duration.0 / 5_000).map(|step| path.at(Span(step * 5_000)).position).collect();
        let on_its_way = track.iter().map(|(_, at)| *at).take_while(|at| at.distance(path.end()) > 0.005);
        for at in on_its_way {
            let off_m = way.iter().map(|there| there.distance(at)).fold(f64::INFINITY, f64::min);
            furthest = furthest.max(off_m);
        }
    }
    furthest
}

fn ends_well(driver: &mut Running) {
    let status = driver.0.wait().expect("a child can be waited for");
    assert!(status.success(), "a driver did not end well: {status}");
}

/// The driver passes sensor readings to the core, so the robot does not drive into one in its path.
#[test]
fn a_driver_sees_a_robot_in_its_way() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile("way");
    let socket = folder.join("floor");
    let (start, dead) = (Vec2::new(0.0, -0.5), Vec2::new(0.004, 0.0));
    let floor = Floor::open(&socket, &Stage::default(), &[start, dead], 1, (Pace::WEBOTS, 1));
    let (_broker, port) = mosquitto();
    let broker = format!("mqtt://127.0.0.1:{port}");
    let mut driver = driver(1, &broker, &socket, &[]);
    let report = lead::into_its_way(&broker, id(1), start, Vec2::new(0.0, 0.5));
    let account = floor.close();
    ends_well(&mut driver);
    let _ = std::fs::remove_dir_all(&folder);
    let details = report.details.expect("a robot of ours");
    assert!(details.simulated, "a robot of Webots is no real one");
    let blocked = details.blocked.expect("it says so");
    // The robot reports as soon as it brakes, within the range of its sensors.
    assert!(blocked.gap_m < 0.03, "{blocked:?}");
    assert!((blocked.towards - std::f64::consts::FRAC_PI_2).abs() < 0.4, "{blocked:?}");
    assert_eq!(account.contacts, 0);
    // It stops within half of the room that the route leaves, and then backs away by 8 mm at most.
    assert!(account.places[0].distance(dead) < 0.054 + 0.5 * lead::ROOM_M + 0.008, "{:?}", account.places);
}

/// Webots' motors continue with the last command when their controller is gone.
#[test]
fn a_robot_whose_driver_is_killed_stops_by_itself() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile("killed");
    let socket = folder.join("floor");
    let (start, end) = (Vec2::new(0.0, -1.2), Vec2::new(0.0, 1.2));
    let floor = Floor::open(&socket, &Stage::default(), &[start], 1, (Pace::WEBOTS, 1));
    let (_broker, port) = mosquitto();
    let broker = format!("mqtt://127.0.0.1:{port}");
    let mut driver = driver(1, &broker, &socket, &[]);
    lead::drive_until(&broker, id(1), (start, end), |report| {
        report.at.is_some_and(|at| at.distance(start) > 0.3)
    });
    driver.0.kill().expect("it runs");
    let killed = Instant::now();
    floor.wait(1.0);
    let account = floor.close();
    let _ = std::fs::remove_dir_all(&folder);
    let track = &account.tracks[0];
    // The median speed at cruise is taken, because a robot catches up with its route after a pause of the machine.
    let cruising = track.iter().filter(|(moment, at)| *moment <= killed && at.distance(start) > 0.1);
    let cruising: Vec<Vec2> = cruising.map(|(_, at)| *at).collect();
    let mut driven_m: Vec<f64> = cruising.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    driven_m.sort_by(f64::total_cmp);
    let usual_mps = driven_m[driven_m.len() / 2] / (f64::from(STEPS_A_PLACE) * STEP.as_secs());
    assert!((0.24..0.27).contains(&usual_mps), "it drove: {usual_mps} m/s");
    let last_driven = track.iter().rfind(|(moment, _)| *moment <= killed).expect("it drove before");
    let rolled_m = account.places[0].distance(last_driven.1);
    // Up to 25 mm lie between the last sample of the track and the place at the kill.
    assert!(rolled_m < 0.065, "it rolled on for {rolled_m} m");
    assert!(track[track.len() - 1].1.distance(track[track.len() - 3].1) < 1e-3, "it still drives");
}

/// The show with a heart, or the one that `LIGHTBOTS_SHOW` names.
#[test]
fn thirty_processes_play_a_show() {
    let file = std::env::var("LIGHTBOTS_SHOW").unwrap_or_else(|_| "heart.lightbots.json".into());
    let format = for_file(&file).expect("a file of a known format");
    plays_without_contact(&show(&file, usize::MAX), format);
}

#[test]
fn thirty_processes_begin_another_show() {
    plays_without_contact(&show("rings.lightbots.json", 2), &LIGHTBOTS);
}

#[test]
fn thirty_processes_begin_a_show_in_the_originals_format_on_the_ways_of_its_rehearsal() {
    let show = show("hello.json", 2);
    let tracks = plays_without_contact(&show, &ORIGINAL);
    let off_m = furthest_off(&show, &tracks);
    assert!(off_m <= 0.005, "a robot was {:.1} mm beside its way in the rehearsal", off_m * 1e3);
}
