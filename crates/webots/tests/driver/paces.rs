//! Shows in worlds that are slow, jitter and pause. `cargo xtask webots paces` plays them all and prints the table. The
//! test itself plays the beginning of one show in the worst of them.

use std::sync::PoisonError;

use lightbots_exchange::{Format, LIGHTBOTS, for_file};
use lightbots_show::Show;

use crate::pace::Pace;
use crate::{TURN, off_m, play, show};

/// The pace of a world, and a requirement besides that no robots touch and none drops out.
struct Scenario {
    name: &'static str,
    pace: Pace,
    /// Largest distance of robots from their due places, metres. If it is set, the fleet must not wait either.
    due_m: Option<f64>,
}

const fn scenario(name: &'static str, pace: Pace) -> Scenario {
    Scenario { name, pace, due_m: None }
}

const ALL: [Scenario; 6] = [
    Scenario { due_m: Some(0.010), ..scenario("0.97 x", Pace::WEBOTS) },
    scenario("0.8 x", Pace::at(0.8)),
    scenario("pauses of 0.4 s", Pace::pausing(0.4)),
    scenario("pauses of 0.9 s", Pace::pausing(0.9)),
    scenario("pauses of 2.5 s", Pace::pausing(2.5)),
    scenario("0.8 x, pauses of 0.9 s", Pace { pause_s: 0.9, ..Pace::at(0.8) }),
];

#[test]
#[allow(clippy::print_stdout)]
fn robots_stay_apart_whatever_the_pace_of_their_world() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let Ok(files) = std::env::var("LIGHTBOTS_PACES") else {
        // The two worlds that are hardest for robots and controller.
        let worlds = &ALL[ALL.len() - 2..];
        let wrong =
            worlds.iter().flat_map(|world| wrong_in(world, &show("rings.lightbots.json", 2), &LIGHTBOTS));
        assert_eq!(wrong.collect::<Vec<_>>(), Vec::<String>::new());
        return;
    };
    println!(
        "\n| world | show | x real time | frames | s | holds | stops | dropouts | contacts | closest mm | off mm \
         | from due mm |\n|---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    let mut wrong = Vec::new();
    for (file, scenario) in files.split(',').flat_map(|file| ALL.iter().map(move |scenario| (file, scenario)))
    {
        let format = for_file(file).expect("a file of a known format");
        wrong.extend(wrong_in(scenario, &show(file, usize::MAX), format));
    }
    assert_eq!(wrong, Vec::<String>::new());
}

/// Plays a show in a world and prints a line of the table. Returns what is wrong.
#[allow(clippy::print_stdout)]
fn wrong_in(scenario: &Scenario, show: &Show, format: &Format) -> Vec<String> {
    let (report, account, score) = play(show, format, scenario.pace);
    let (holds, stops) = score.holds();
    let (_, due_m) = off_m(&score, &account);
    let closest_m = account.closest_m.unwrap_or(f64::INFINITY);
    println!(
        "| {} | {} | {:.3} | {} | {:.1} | {holds} | {stops} | {} | {} | {:.1} | {:.1} | {:.1} |",
        scenario.name,
        show.name,
        account.rate,
        report["frames_played"],
        report["duration_s"].as_f64().unwrap_or_default(),
        report["dropouts"],
        account.contacts,
        closest_m * 1e3,
        score.off_m() * 1e3,
        due_m * 1e3,
    );
    let all = report["dropouts"] == 0 && report["frames_played"] == show.frames.len();
    let on_time = scenario.due_m.is_none_or(|most_m| due_m <= most_m && (holds, stops) == (0, 0));
    let held = [
        (account.contacts == 0, "robots touched"),
        (all, "a robot dropped out"),
        (on_time, "robots were late or waited"),
    ];
    let wrong = held.iter().filter(|(holds, _)| !holds);
    wrong
        .map(|(_, what)| format!("{}, {}: {what}: {:#}", scenario.name, show.name, report["issues"]))
        .collect()
}
