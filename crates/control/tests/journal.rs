//! Journals of runs: what can be read from them at each moment, and from a journal with any damage.

mod fleet;

use fleet::{World, show};
use lightbots_base::Span;
use lightbots_control::{EventKind, JOURNAL_OUTDATED, JournalError, Operation, RunOutcome, UnfinishedRun};

/// A run of three robots with a pause and a dropout, and the unfinished run that was read after each piece of the
/// journal.
fn written_run() -> (World, Vec<Option<UnfinishedRun>>) {
    let mut world = World::ready(3, 0, show(3, 3, 0.4));
    world.controller.keep_journal();
    world.play();
    let mut said = Vec::new();
    let is_over = |world: &World| world.count(|kind| matches!(kind, EventKind::RunEnded { .. })) > 0;
    let mut paused_at = None;
    while !is_over(&world) {
        world.step();
        if world.journal_ends.len() > said.len() {
            said.push(UnfinishedRun::read(&world.journal).unwrap());
        }
        let frames = world.count(|kind| matches!(kind, EventKind::FrameReached { .. }));
        if frames == 1 && paused_at.is_none() {
            paused_at = Some(world.now);
            world.operate(Operation::Pause).unwrap();
            world.robots[2].dead = true;
        } else if paused_at.is_some_and(|at| world.now - at == Span::from_millis(5_000)) {
            world.operate(Operation::Resume).unwrap();
        }
        // An operation may have written a piece.
        while world.journal_ends.len() > said.len() {
            said.push(UnfinishedRun::read(&world.journal).unwrap());
        }
    }
    (world, said)
}

#[test]
fn a_journal_says_where_the_run_is() {
    let (world, said) = written_run();
    assert_eq!(said.len(), world.journal_ends.len());
    assert_eq!(said.last(), Some(&None), "the run was ended");
    let runs: Vec<&UnfinishedRun> = said.iter().flatten().collect();
    assert!(runs.windows(2).all(|pair| pair[0].frames_played() <= pair[1].frames_played()));
    assert_eq!(runs.iter().map(|run| run.frames_played()).max(), Some(3));
    assert!(runs.iter().all(|run| run.show().frames.len() == 3 && run.frame() < 3));
    let longest = runs.windows(2).map(|pair| pair[1].last_change() - pair[0].last_change()).max();
    assert!(longest.unwrap() < Span::from_millis(2_300), "{longest:?}");
}

#[test]
fn a_journal_that_was_cut_ends_with_its_last_whole_entry() {
    let (world, said) = written_run();
    for cut in 0..=world.journal.len() {
        let whole = world.journal_ends.iter().filter(|&&end| end <= cut).count();
        let expected = match whole.checked_sub(1) {
            Some(last) => Ok(said[last].clone()),
            None if cut < 8 => Err(JournalError::NoJournal),
            None => Err(JournalError::NoEntry),
        };
        assert_eq!(UnfinishedRun::read(&world.journal[..cut]), expected, "cut at {cut}");
    }
}

#[test]
fn a_journal_with_a_changed_byte_ends_before_it() {
    let (world, said) = written_run();
    for at in (0..world.journal.len()).filter(|&at| at != JOURNAL_OUTDATED.0) {
        let mut changed = world.journal.clone();
        changed[at] ^= 1 << (at % 8);
        let whole = world.journal_ends.iter().filter(|&&end| end <= at).count();
        let expected = match whole.checked_sub(1) {
            Some(last) => Ok(said[last].clone()),
            None if at < 8 => Err(JournalError::NoJournal),
            None if at < 10 => Err(JournalError::OtherVersion(u16::from_le_bytes([changed[8], changed[9]]))),
            None => Err(JournalError::NoEntry),
        };
        assert_eq!(UnfinishedRun::read(&changed), expected, "changed at {at}");
    }
}

#[test]
fn a_journal_stays_small_while_a_show_loops() {
    let mut world = World::ready(12, 0, show(2, 12, 0.0));
    world.controller.keep_journal();
    world.operate(Operation::Loop(true)).unwrap();
    world.play();
    let mut frames_before = 0;
    world.run_for(20.0);
    let first = world.journal.len();
    // After a lost piece the journal begins again, with the same run.
    world.controller.begin_journal_again();
    world.run_for(3.0);
    assert!(world.journal.len() < first, "{} bytes after {first}", world.journal.len());
    let run = UnfinishedRun::read(&world.journal).unwrap().unwrap();
    frames_before += world.count(|kind| matches!(kind, EventKind::FrameReached { .. }));
    assert_eq!(run.frames_played(), frames_before);
    world.operate(Operation::Loop(false)).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished);
    assert_eq!(UnfinishedRun::read(&world.journal), Ok(None));
}
