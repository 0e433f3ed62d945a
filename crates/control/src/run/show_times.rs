//! The timeline of frames. Each frame has three show times: the drive to it begins, its air time (stay of robots in it)
//! begins, and its air time ends.

use crate::run::playback::PlayedShow;
use lightbots_base::Span;
use lightbots_lighting::FrameTimes;
use std::collections::BTreeMap;

/// Show times of the frames of one round of a show.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShowTimes {
    /// `[frame]`: show times of the frames to which a drive was begun.
    pub begun: BTreeMap<usize, FrameTimes>,
    /// `[frame]`: show time at which the air time of the frame is due, seconds. If robots are late, the air time begins
    /// later.
    pub due: BTreeMap<usize, f64>,
    /// `[frame]`: how long the drive to the frame from the one before it was first planned to take.
    drives: BTreeMap<usize, Span>,
}

impl ShowTimes {
    /// Notes how long the drive to a frame from the one before it is planned to take. Only the first plan counts.
    pub fn plan_drive(&mut self, frame: usize, takes: Span) {
        self.drives.entry(frame).or_insert(takes);
    }

    /// Show time, seconds, at which the air time of `frame` begins if all frames before it are played. It counts from
    /// the last frame, up to `frame`, to which a drive was begun; without one, from the first frame at 0. Drives after
    /// that count with their planned durations, or else with the durations that the show asks for, or with 0.
    pub fn begin_s(&self, playback: &PlayedShow, frame: usize) -> f64 {
        let begun = self.begun.range(..=frame).rev().find(|(_, times)| times.air_s.is_finite());
        self.count_s(playback, begun.map_or((0, 0.0), |(&first, times)| (first, times.air_s)), frame)
    }

    /// As [`ShowTimes::begin_s`], but without the delays of late robots: show time at which the air time of `frame` is
    /// due, seconds.
    pub fn due_s(&self, playback: &PlayedShow, frame: usize) -> f64 {
        let due = self.due.range(..=frame).next_back();
        self.count_s(playback, due.map_or((0, 0.0), |(&first, &due_s)| (first, due_s)), frame)
    }

    /// Show time at which the air time of `frame` begins, seconds, if that of the frame `first` begins at `begun_s`.
    fn count_s(&self, playback: &PlayedShow, (first, begun_s): (usize, f64), frame: usize) -> f64 {
        let takes_s = |frame: usize| playback.air_time(frame).as_secs() + self.drive_s(playback, frame + 1);
        begun_s + (first..frame).map(takes_s).sum::<f64>()
    }

    /// How long the drive to a frame was first planned to take, seconds. `None` if it was not planned yet.
    pub fn planned_s(&self, frame: usize) -> Option<f64> {
        self.drives.get(&frame).map(|drive| drive.as_secs())
    }

    /// Forgets when frames were begun and due, because a new round of the show begins. Planned durations of drives
    /// stay.
    pub fn clear(&mut self) {
        self.begun.clear();
        self.due.clear();
    }

    /// Show time, seconds, at which the drive to a frame begins if all frames before it are played. `None` if that
    /// drive was neither begun nor planned.
    pub fn drive_begin_s(&self, playback: &PlayedShow, frame: usize) -> Option<f64> {
        let begun = self.begun.get(&frame).map(|times| times.drive_s);
        let planned = self.drives.get(&frame).map(|drive| self.begin_s(playback, frame) - drive.as_secs());
        begun.or(planned)
    }

    /// Counts frames before `frame` that were skipped as begun. Layers of light that span several frames then count
    /// from the first of these frames.
    pub fn begin_earlier(&mut self, playback: &PlayedShow, frame: usize) {
        for earlier in 0..frame {
            let air_s = self.begin_s(playback, earlier);
            let drive_s = air_s - self.drive_s(playback, earlier);
            let end_s = air_s + playback.air_time(earlier).as_secs();
            self.begun.entry(earlier).or_insert(FrameTimes { drive_s, air_s, end_s });
        }
    }

    fn drive_s(&self, playback: &PlayedShow, frame: usize) -> f64 {
        let wanted = playback.show.frames.get(frame).and_then(|frame| frame.transition_s);
        self.planned_s(frame).or(wanted).unwrap_or(0.0)
    }
}
