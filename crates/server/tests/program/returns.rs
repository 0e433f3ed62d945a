//! `run` is killed in a show, and continues it when it is started again. Robots and broker are separate processes.

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};

use crate::child::{Child, run};
use crate::screen::Screen;
use crate::{alone, http, shows, wait_for};

/// Times of the kills, milliseconds after the screen shows that robots drive to a frame: in drives, in air times, and
/// between them.
const MOMENTS_MS: [u64; 7] = [900, 150, 1_700, 2_400, 500, 1_200, 2_000];
/// Number of simulated robots.
const ROBOTS: &str = "6";

/// A broker, its robots, and the data folder and show of a controller that is killed repeatedly.
struct Stage {
    broker: Child,
    _robots: Child,
    url: String,
    data: PathBuf,
    show: String,
}

impl Stage {
    /// Starts broker and robots, for a show of this number of frames that are half a metre apart.
    fn new(frames: usize) -> Self {
        let mut broker = Child::lightbots(&["broker", "--mqtt-listen", "127.0.0.1:0"]);
        let url = format!("mqtt://{}", broker.said("Broker mqtt://"));
        let robots = Child::lightbots(&["robots", "--count", ROBOTS, "--broker", &url]);
        let mut show = shows::row(6, &vec![0.6; frames]);
        for frame in 0..frames {
            let (stood, stands) = (1.2 - 0.1 * frame as f64, if frame % 2 == 0 { 0.7 } else { 0.2 });
            show = show.replace(&format!(",{stood:.3}]"), &format!(",{stands:.4}]"));
        }
        let show = shows::file("rows.lightbots.json", show);
        Self { broker, _robots: robots, url, data: shows::own_folder(), show }
    }

    fn controller(&self, more: &[&str]) -> (Child, Screen, String) {
        let data = self.data.to_str().unwrap();
        let arguments =
            ["run", "--listen", "127.0.0.1:0", "--robots", "0", "--broker", &self.url, "--data", data];
        let mut server = Child::lightbots(&[&arguments, more, &[&self.show]].concat());
        let address = server.said("http://");
        (server, Screen::open(&address), address)
    }

    fn journal(&self) -> PathBuf {
        self.data.join("runs/present.lbjournal")
    }
}

fn play(screen: &mut Screen) {
    screen.wait_for_robots(6);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
}

/// Waits until robots drive to this frame or a later one.
fn wait_for_frame(screen: &mut Screen, frame: u64) {
    screen.until(&format!("the drive to frame {frame}"), |screen| {
        let playback = &screen.get("state")["playback"];
        let is_there =
            playback["phase"] == "playing" && playback["frame"].as_u64().is_some_and(|at| at >= frame);
        is_there.then_some(())
    });
}

/// Saves a show. Returns its path and the `ETag` of the answer.
fn save(address: &str, number: usize) -> (String, String) {
    let path = format!("/api/shows/kept%20{number}");
    let body = shows::row(2, &[1.0]).replace("Rows", &format!("Kept {number}"));
    let answer = http::request(address, "PUT", &path, &[("If-None-Match", "*")], &body);
    assert_eq!(answer.status, 200, "{}", answer.body);
    (path, answer.header("ETag"))
}

/// Kills three times by default. `LIGHTBOTS_KILLS=20` kills more often.
#[test]
fn a_show_whose_controller_is_killed_again_and_again_is_finished() {
    let _turn = alone();
    let kills = std::env::var("LIGHTBOTS_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(3);
    let stage = Stage::new(kills + 1);
    let (mut server, mut screen, mut address) = stage.controller(&[]);
    play(&mut screen);
    let mut saved = Vec::new();
    for kill in 0..kills {
        wait_for_frame(&mut screen, kill as u64);
        saved.push(save(&address, kill));
        std::thread::sleep(Duration::from_millis(MOMENTS_MS[kill % MOMENTS_MS.len()]));
        server.kill();
        (server, screen, address) = stage.controller(&[]);
        assert!(server.out().contains("it goes on from where the robots stand"), "{}", server.out());
        screen.wait_for_log("The show was cut off");
        for (path, etag) in &saved {
            assert_eq!(&http::request(&address, "GET", path, &[], "").header("ETag"), etag, "{path}");
        }
    }
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains(&format!("{} frames", kills + 1)) && last.contains("0 dropouts"), "{last}");
    wait_for("the end of the journal", || (!stage.journal().exists()).then_some(()));
    server.terminate();
    assert_eq!(server.end(), 0);
    let (number, data) = ((kills + 1).to_string(), stage.data.to_str().unwrap());
    let (_, out, _) = run(&["replay", "--json", &number, "--data", data]);
    let report: Value = serde_json::from_str(&out).unwrap_or_default();
    assert_eq!((&report["complete"], &report["difference"]), (&json!(true), &Value::Null), "{report}");
    assert!(report["notes"]["taken_up"].is_string(), "{report}");
    let (mut server, mut screen, _) = stage.controller(&[]);
    screen.wait_for_robots(6);
    assert!(!server.out().contains("cut off"), "{}", server.out());
    server.kill();
}

#[test]
fn a_show_that_was_cut_off_waits_for_the_operator_or_is_over_where_that_is_wanted() {
    let _turn = alone();
    let stage = Stage::new(3);
    let (mut server, mut screen, _) = stage.controller(&[]);
    play(&mut screen);
    wait_for_frame(&mut screen, 1);
    server.kill();
    (server, screen, _) = stage.controller(&["--on-return", "ask"]);
    assert!(server.out().contains("press Go on or Stop on the screen"), "{}", server.out());
    screen.wait_for_log("Look at the floor, then press Go on");
    screen.until("the question", |screen| {
        let playback = &screen.get("state")["playback"];
        let asks = playback["phase"] == "link_lost" && playback["doing"] == "waiting for you to go on";
        asks.then_some(())
    });
    screen.must(json!({"do": "go_on"}));
    wait_for_frame(&mut screen, 1);
    server.kill();
    assert!(is_written(&stage.journal()));
    (server, screen, _) = stage.controller(&["--on-return", "stop"]);
    assert!(server.out().contains("the robots are told to stop"), "{}", server.out());
    screen.wait_for_log("the run is over");
    wait_for("the end of the journal", || (!stage.journal().exists()).then_some(()));
    screen.wait_for_robots(6);
}

#[test]
fn a_program_that_is_stopped_while_the_broker_is_away_does_not_go_on_with_its_show() {
    let _turn = alone();
    let mut stage = Stage::new(3);
    let (mut server, mut screen, _) = stage.controller(&[]);
    play(&mut screen);
    wait_for_frame(&mut screen, 1);
    stage.broker.kill();
    screen.until("the lost link", |screen| (screen.phase() == "link_lost").then_some(()));
    assert!(is_written(&stage.journal()));
    server.terminate();
    server.end();
    assert!(!stage.journal().exists());
}

fn is_written(journal: &Path) -> bool {
    journal.metadata().is_ok_and(|file| file.len() > 0)
}
