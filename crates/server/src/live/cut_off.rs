//! A run that was cut off when the program was killed: what is known of it at the next start.

use std::path::Path;

use lightbots_api::ShowOrigin;
use lightbots_base::Instant;
use lightbots_control::{Config, OnReturn, UnfinishedRun};
use lightbots_show::Show;

use super::clock::{Clock, unix_us};
use super::journal;
use crate::cli::OnReturnArgument;
use crate::library::Library;
use crate::say;

/// A run that was cut off.
#[derive(Debug)]
pub struct CutOffRun {
    pub unfinished: UnfinishedRun,
    /// What happens to it.
    pub on_return: OnReturn,
}

impl CutOffRun {
    /// The run that a killed program left in its data folder, if there is one. A journal that cannot be read is told.
    pub fn find(data: &Path, on_return: Option<OnReturnArgument>) -> Option<Self> {
        let unfinished = journal::unfinished_run(data).unwrap_or_else(|line| {
            say::error(&line);
            None
        })?;
        Some(Self { unfinished, on_return: on_return.map_or(OnReturn::GoOrAsk, OnReturn::from) })
    }

    /// The clock that goes on from the run's.
    pub fn clock(&self) -> Clock {
        Clock::starting_at(self.unfinished.show_clock_at(unix_us()).0)
    }

    /// The show for the screen with its name in the library: the run's, which may have been changed there since.
    /// `first`: the show that would be opened otherwise.
    pub fn show_on_screen(&self, library: &Library, first: (Option<String>, Show)) -> (Option<String>, Show) {
        let (show, (name, other)) = (self.unfinished.show(), first);
        // The controller names a show without a name as the library does.
        let same = Show { name: show.name.clone(), ..other.clone() } == **show;
        if same && name.is_some() {
            return (name, other);
        }
        let listed = library.give(&show.name, ShowOrigin::StartFile, show, None);
        (Some(listed), (**show).clone())
    }

    /// Tells the command line of the run at a moment of its clock.
    pub fn tell(&self, now: Instant) {
        let (run, (last, _)) = (&self.unfinished, self.unfinished.last_written());
        let goes_on = "it goes on from where the robots stand";
        let asks = "press Go on or Stop on the screen";
        let then = match self.on_return {
            OnReturn::Go => goes_on,
            OnReturn::Ask => asks,
            OnReturn::Stop => "the robots are told to stop, and it is over",
            OnReturn::GoOrAsk if now - last <= Config::default().waits.goes_on_within => goes_on,
            OnReturn::GoOrAsk => asks,
        };
        say::line(&format!(
            "The show \"{}\" was cut off {:.0} s ago on the way to frame {} of {}: {then}",
            run.show().name,
            (now - last).as_secs(),
            run.frame() + 1,
            run.show().frames.len()
        ));
    }
}
