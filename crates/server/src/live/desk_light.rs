//! The task between lighting desks and robots. It gives packets of desks and reports of robots to the receiver, and
//! publishes the live light that the receiver makes of them.

use std::path::Path;

use lightbots_api::Level;
use lightbots_dmx::{DeskNews, DeskReceiver, PatchTable};
use lightbots_lighting::LampSettings;
use lightbots_wire::Report;
use tokio::sync::mpsc;

use super::clock::{Clock, seq_base};
use super::conductor::Handle;
use super::desk_sockets::DeskSockets;
use crate::cli::DeskArguments;
use crate::disk;
use crate::failure::Failure;
use crate::stop::Stop;
use crate::web::ScreenLog;

/// Longest patch table, bytes: room for 20,000 robots with long names and comments.
const PATCH_MAX: u64 = 4 << 20;
/// Most reports that are handled before other inputs get a turn.
const BATCH: usize = 256;

/// The sockets of lighting desks, and the receiver that turns their packets into messages to robots.
#[derive(Debug)]
pub struct DeskLight {
    sockets: DeskSockets,
    receiver: DeskReceiver,
}

impl DeskLight {
    /// Binds the sockets and reads the patch table. `None` if the command line asks for no lighting desk. A patch table
    /// without a desk is an error.
    pub async fn open(arguments: &DeskArguments, lamp: LampSettings) -> Result<Option<Self>, Failure> {
        let patch = match &arguments.patch {
            Some(file) => patch_table(file)?,
            None => PatchTable::default(),
        };
        let Some(sockets) = DeskSockets::bind(arguments).await? else {
            let is_idle = arguments.patch.is_some();
            let line = "--patch is for lighting desks: add --artnet or --sacn";
            return if is_idle { Err(Failure::input(line)) } else { Ok(None) };
        };
        Ok(Some(Self { sockets, receiver: DeskReceiver::new(patch, seq_base(), lamp) }))
    }

    /// Receives packets and reports, and publishes live light, until `stop` is wanted.
    pub async fn run(mut self, handle: Handle, log: ScreenLog, stop: Stop) {
        let mut reports = handle.overhear().await;
        let clock = handle.clock();
        loop {
            let alarm = self.receiver.wake_at(clock.now()).map(|at| clock.deadline(at));
            tokio::select! {
                () = stop.wait() => return,
                packet = self.sockets.next() => self.receiver.packet(clock.now(), packet),
                Some(report) = reports.recv() => self.hear(&clock, &report, &mut reports),
                () = sleep_until(alarm) => {}
            }
            self.receiver.wake(clock.now());
            self.drain(&handle, &log).await;
        }
    }

    /// Handles `first` and further reports that wait already, at most `BATCH` in total.
    fn hear(&mut self, clock: &Clock, first: &[u8], reports: &mut mpsc::Receiver<Vec<u8>>) {
        let now = clock.now();
        let mut take = |payload: &[u8]| {
            if let Some(report) = Report::decode(payload) {
                self.receiver.report(now, &report);
            }
        };
        take(first);
        for _ in 1..BATCH {
            let Ok(payload) = reports.try_recv() else { break };
            take(&payload);
        }
    }

    async fn drain(&mut self, handle: &Handle, log: &ScreenLog) {
        let mut messages = Vec::new();
        while let Some(message) = self.receiver.next_publish() {
            messages.push(message);
        }
        // Lights change only with a message.
        if !messages.is_empty() {
            handle.desk_lights().set(self.receiver.lights());
            handle.publish(messages).await;
        }
        if let Some(warning) = self.sockets.join(self.receiver.universes()) {
            log.say(Level::Warn, warning);
        }
        while let Some(news) = self.receiver.next_news() {
            let (level, line) = words(news);
            tracing::info!("{line}");
            log.say(level, line);
        }
    }
}

fn words(news: DeskNews) -> (Level, String) {
    match news {
        DeskNews::Began { robots: 1 } => (Level::Info, "A lighting desk drives the light of 1 robot.".into()),
        DeskNews::Began { robots } => {
            (Level::Info, format!("A lighting desk drives the lights of {robots} robots."))
        }
        DeskNews::Ended => {
            (Level::Info, "The lighting desk sends no more: robots show their own lights again.".into())
        }
        DeskNews::Unpatched { universes, has_more } => (Level::Warn, unpatched_line(&universes, has_more)),
    }
}

/// Returns the line for people about universes to which no robot is patched. `has_more`: there are further ones that
/// `universes` does not list.
fn unpatched_line(universes: &[u16], has_more: bool) -> String {
    let mut named: Vec<String> = universes.iter().map(u16::to_string).collect();
    named.extend(has_more.then(|| "more".into()));
    let what = match (universes, named.pop()) {
        ([], _) => "further universes".into(),
        ([one], _) if !has_more => format!("universe {one}"),
        (_, last) => format!("universes {} and {}", named.join(", "), last.unwrap_or_default()),
    };
    format!("A lighting desk sends {what} without robots: see the patch table.")
}

fn patch_table(file: &Path) -> Result<PatchTable, Failure> {
    let bytes = disk::read_regular(file, PATCH_MAX)
        .map_err(|error| Failure::input(format!("{} cannot be read: {error}", file.display())))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Failure::input(format!("{} is no text: save it as UTF-8", file.display())))?;
    PatchTable::read(&text).map_err(|error| Failure::input(format!("{}, {error}", file.display())))
}

async fn sleep_until(alarm: Option<tokio::time::Instant>) {
    match alarm {
        Some(alarm) => tokio::time::sleep_until(alarm).await,
        None => std::future::pending().await,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_universes_without_robots_are_named() {
        for (universes, has_more, list) in [
            (&[7][..], false, "universe 7"),
            (&[7, 9], false, "universes 7 and 9"),
            (&[2, 7, 9], false, "universes 2, 7 and 9"),
            (&[2, 7], true, "universes 2, 7 and more"),
            (&[], true, "further universes"),
        ] {
            let line = unpatched_line(universes, has_more);
            assert_eq!(line, format!("A lighting desk sends {list} without robots: see the patch table."));
        }
    }
}
