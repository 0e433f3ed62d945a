//! The show's position on its timeline, which screens use to play music.

use serde_json::json;

use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows};

/// The show's time in a message to a screen: the server's show clock (`at_ms`, milliseconds), the position on the
/// timeline (`show_s`, seconds), and whether the position runs.
struct Heard {
    at_ms: f64,
    show_s: f64,
    runs: bool,
}

fn heard(screen: &Screen) -> Option<Heard> {
    let state = screen.get("state");
    let time = state["show_time"].as_object()?;
    Some(Heard {
        at_ms: state["at_ms"].as_f64()?,
        show_s: time["show_s"].as_f64()?,
        runs: time["runs"].as_bool()?,
    })
}

#[test]
fn show_time_runs_with_the_show_and_stands_in_a_pause() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "4", &shows::row_file(4, &[2.0, 2.0])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    assert!(heard(&screen).is_none());
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    let mut all: Vec<Heard> = Vec::new();
    let mut listen = |screen: &mut Screen, what: &str, is_done: &dyn Fn(&Screen) -> bool| {
        screen.until(what, |screen| {
            if let Some(now) = heard(screen)
                && all.last().is_none_or(|last| now.at_ms > last.at_ms)
            {
                all.push(now);
            }
            is_done(screen).then_some(())
        });
    };
    let is_showing = |frame: u64| {
        move |screen: &Screen| {
            let playback = &screen.get("state")["playback"];
            playback["frame"] == frame && playback["doing"] == "showing"
        }
    };
    listen(&mut screen, "the first picture", &is_showing(0));
    listen(&mut screen, "the drive to the second", &|screen| {
        heard(screen).is_some_and(|heard| heard.show_s > 2.2)
    });
    screen.must(json!({"do": "pause"}));
    listen(&mut screen, "a pause", &|screen| screen.phase() == "paused");
    std::thread::sleep(std::time::Duration::from_millis(1_500));
    listen(&mut screen, "standing time", &|screen| heard(screen).is_some_and(|heard| !heard.runs));
    screen.must(json!({"do": "resume"}));
    listen(&mut screen, "the second picture", &is_showing(1));
    listen(&mut screen, "the end", &|screen| screen.phase() == "ready");

    let first = all.first().expect("time was heard");
    assert!(first.show_s < 0.0, "the first drive is before the music: {}", first.show_s);
    for pair in all.windows(2) {
        let (passed_s, moved_s) =
            ((pair[1].at_ms - pair[0].at_ms) / 1_000.0, pair[1].show_s - pair[0].show_s);
        assert!(moved_s > -0.03, "it went back by {moved_s} s at {} s", pair[0].show_s);
        assert!(moved_s < passed_s + 0.03, "it ran ahead by {} s", moved_s - passed_s);
        if pair[0].runs && pair[1].runs && passed_s < 0.5 {
            assert!((moved_s - passed_s).abs() < 0.03, "{moved_s} s in {passed_s} s at {} s", pair[0].show_s);
        }
    }
    let standing = all.iter().filter(|heard| !heard.runs && heard.show_s > 2.2).count();
    assert!(standing > 10, "{standing} messages of the pause");
    let last = all.last().expect("time was heard");
    assert!(last.show_s > 4.0, "the show has two air times of 2 s and a drive: {}", last.show_s);
}
