//! One cause, one card.

use super::*;
use lightbots_base::{Instant, Span};
use lightbots_control::RunOutcome;

fn robot(number: usize) -> RobotId {
    RobotId::new(&number.to_string()).unwrap()
}

fn lost(number: usize) -> EventKind {
    EventKind::Dropout { robot: robot(number), why: Trouble::Silent }
}

fn leaving(frame: usize) -> EventKind {
    EventKind::TransitionStarted { frame, starts: Instant::ZERO, duration: Span::ZERO }
}

fn titles(book: &Book) -> Vec<&str> {
    book.entries.iter().map(|entry| entry.incident.title.as_str()).collect()
}

#[test]
fn robots_that_fail_together_are_one_card_and_later_ones_another() {
    let mut book = Book::default();
    assert!(!book.note(&leaving(2), 0));
    assert!(book.note(&lost(7), 1_000) && book.note(&lost(8), 2_000));
    assert_eq!(titles(&book), ["Robots 7 and 8 fell silent in frame 3 – their pixels are left dark."]);
    assert!(book.note(&lost(9), 9_000));
    assert_eq!(book.entries.len(), 2);
    assert_eq!((book.entries[0].incident.id, book.entries[1].incident.id), (1, 2));
}

#[test]
fn a_card_is_over_when_all_its_robots_take_part_again() {
    let mut book = Book::default();
    book.note(&lost(7), 0);
    book.note(&lost(8), 0);
    assert!(!book.note(&EventKind::Rejoined(robot(7)), 1));
    assert!(book.note(&EventKind::Rejoined(robot(8)), 2) && book.entries[0].incident.over);
}

#[test]
fn a_card_names_and_counts_each_of_its_robots_once() {
    let mut book = Book::default();
    book.note(&lost(7), 0);
    book.note(&lost(8), 0);
    book.note(&EventKind::Rejoined(robot(7)), 1);
    book.note(&EventKind::Rejoined(robot(8)), 2);
    book.note(&lost(7), 3);
    book.note(&lost(9), 4);
    let incident = &book.entries[0].incident;
    assert_eq!((incident.robots.join(" "), incident.count, incident.over), ("7 8 9".to_owned(), 3, false));
    assert_eq!(titles(&book), ["Robots 7, 8 and 9 fell silent – their pixels are left dark."]);
    assert!(!book.note(&EventKind::Rejoined(robot(9)), 5));
    assert!(book.note(&EventKind::Rejoined(robot(7)), 6) && book.entries[0].incident.over);
}

#[test]
fn a_lost_link_is_one_card_until_it_is_back() {
    let mut book = Book::default();
    book.note(&EventKind::LinkLost { silent: 24, robots: 60 }, 0);
    book.note(&EventKind::LinkLost { silent: 60, robots: 60 }, 9_000);
    assert_eq!(titles(&book), ["60 of 60 robots fell silent at once: this is the link, not the robots."]);
    let back =
        |asks_operator| EventKind::LinkBack { reported: 60, robots: 60, after: Span::ZERO, asks_operator };
    book.note(&back(true), 20_000);
    assert!(book.entries[0].incident.advice.contains("Go on") && !book.entries[0].incident.over);
    book.note(&back(false), 21_000);
    assert!(book.entries[0].incident.over);
}

#[test]
fn a_flood_of_incidents_keeps_the_unread_ones_and_a_bounded_number() {
    let board = IncidentBoard::new();
    let note = |kind: &EventKind, at: u64| board.change(|book| book.note(kind, at));
    note(&lost(1), 0);
    (2..200).for_each(|number| note(&lost(number), number as u64 * 10_000));
    let ids = |board: &IncidentBoard| {
        board.book.lock().unwrap().entries.iter().map(|entry| entry.incident.id).collect::<Vec<_>>()
    };
    assert_eq!((ids(&board).len(), ids(&board)[0]), (KEPT, 160));
    board.read(170);
    note(&lost(200), 9_000_000);
    assert!(!ids(&board).contains(&170) && ids(&board).contains(&160));
}

#[test]
fn a_growing_card_names_a_bounded_number_of_robots() {
    let mut book = Book::default();
    (0..1_000).for_each(|number| assert!(book.note(&lost(number), 5)));
    let incident = &book.entries[0].incident;
    assert_eq!((incident.count, incident.robots.len()), (1_000, NAMED));
    assert!(incident.title.starts_with("1000 robots fell silent"), "{}", incident.title);
}

/// Whether a warning or error is no incident: it is shown elsewhere, or leads to an incident if it matters.
fn is_shown_elsewhere(kind: &EventKind) -> bool {
    use EventKind as E;
    matches!(
        kind,
        E::RobotStale(_)
            | E::RobotGone(_)
            | E::RobotRestarted(_)
            | E::LeftOut { .. }
            | E::Waiting { .. }
            | E::Replanning { .. }
            | E::UnexpectedArrival(_)
            | E::Suppressed(_)
            | E::StoppedAll
    )
}

#[test]
fn each_warning_and_error_has_a_card_with_three_parts_or_is_shown_elsewhere() {
    let id = robot(7);
    let all = [
        EventKind::Disconnected,
        EventKind::NameShared { robot: id, places: Vec::new() },
        EventKind::Flooding(id),
        EventKind::FleetFull,
        EventKind::PlanFailed { frame: 1, message: "no way".into() },
        EventKind::LeftOutForMusic { frame: 3, late: Span::from_millis(2_300) },
        EventKind::Undelivered,
        EventKind::LinkLost { silent: 9, robots: 9 },
        EventKind::LinkBack { reported: 9, robots: 9, after: Span::ZERO, asks_operator: true },
        EventKind::TakenUp { frame: 1, robots: 9, away: Span::ZERO, goes_on: false },
        EventKind::Misaligned { robot: id, off_m: 0.03 },
        EventKind::RunEnded {
            outcome: RunOutcome::Failed("It failed".into()),
            frames_played: 2,
            dropouts: 9,
        },
        EventKind::RobotStale(id),
        EventKind::RobotGone(id),
        EventKind::RobotRestarted(id),
        EventKind::Waiting { robot: id, why: Trouble::Late },
        EventKind::StoppedAll,
    ];
    for kind in all {
        let card = card_of(&kind);
        assert_eq!(card.is_none(), is_shown_elsewhere(&kind), "{kind:?}");
        if let Some((_, _, card, _)) = card {
            assert!(card.title.ends_with('.') && !card.advice.is_empty(), "{card:?}");
        }
    }
}

#[test]
fn robots_that_want_to_join_are_one_card_until_they_are_listed() {
    let board = IncidentBoard::new();
    for number in [7, 8] {
        board.change(|book| book.note(&EventKind::WantsToJoin(robot(number)), 0));
    }
    let incident = |board: &IncidentBoard| board.book.lock().unwrap().entries[0].incident.clone();
    assert_eq!(incident(&board).title, "Robots 7 and 8 are new and want to join.");
    assert!(incident(&board).wants_to_join && incident(&board).robots == ["7", "8"]);
    board.joined(&[robot(7)]);
    assert!(!incident(&board).over);
    board.change(|book| book.note(&EventKind::WantsToJoin(robot(9)), 0));
    assert_eq!(incident(&board).title, "Robots 7, 8 and 9 are new and want to join.");
    assert_eq!(incident(&board).count, 3);
    board.joined(&[robot(8), robot(9)]);
    assert!(incident(&board).over);
}
