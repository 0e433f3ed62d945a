//! A run that was cut off when the program was killed, as the next start finds it.

use std::path::Path;

use lightbots_api::ShowOrigin;
use lightbots_base::{Instant, Span};
use lightbots_control::{Config, OnReturn, UnfinishedRun};
use lightbots_show::Show;

use super::clock::{Clock, computer_time};
use super::journal;
use crate::cli::OnReturnArgument;
use crate::library::Library;
use crate::say;

/// A run that was cut off.
#[derive(Debug)]
pub struct CutOffRun {
    pub unfinished: UnfinishedRun,
    /// Whether the run goes on by itself, waits for a person, or is over.
    pub on_return: OnReturn,
}

impl CutOffRun {
    /// Finds the run that a killed program left in its data folder; `None` if there is none. If its journal cannot be read,
    /// prints an error and returns `None`.
    pub fn find(data: &Path, on_return: Option<OnReturnArgument>) -> Option<Self> {
        let unfinished = journal::unfinished_run(data).unwrap_or_else(|line| {
            say::error(&line);
            None
        })?;
        Some(Self { unfinished, on_return: on_return.map_or(OnReturn::GoOrAsk, OnReturn::from) })
    }

    /// Returns a show clock that continues the clock of the run.
    pub fn clock(&self) -> Clock {
        Clock::starting_at(self.unfinished.show_clock_at(&computer_time()).0)
    }

    /// Returns the run's show, for screens, with its name in the library. `first` is the name and the show that would
    /// be opened otherwise. It is returned if it has a name and its show equals the run's, names apart. Otherwise the
    /// run's show is added to the library, because the show of that name there may have changed.
    pub fn show_on_screen(&self, library: &Library, first: (Option<String>, Show)) -> (Option<String>, Show) {
        let (show, (name, other)) = (self.unfinished.show(), first);
        // Names are not compared, because a show without a name has its name in the library as its name in the
        // controller.
        let same = Show { name: show.name.clone(), ..other.clone() } == **show;
        if same && name.is_some() {
            return (name, other);
        }
        let listed = library.give(&show.name, ShowOrigin::StartFile, show, None);
        (Some(listed), (**show).clone())
    }

    /// Prints that the run was cut off and what follows. `now` is the present time of the run's show clock.
    pub fn tell(&self, now: Instant) {
        let (run, last) = (&self.unfinished, self.unfinished.last_change());
        let goes_on = "it goes on from where the robots stand";
        let asks = "press Go on or Stop on the screen";
        let within = run.goes_on_within(now, self.on_return, &Config::default().waits);
        let then = match self.on_return {
            OnReturn::Stop => "the robots are told to stop, and it is over",
            _ if within > Span::ZERO => goes_on,
            _ => asks,
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
