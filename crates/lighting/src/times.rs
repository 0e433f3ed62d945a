//! When a frame is driven to and shown.

/// When the drive to a frame begins and when its air time begins and ends, in seconds of show time. Show time is 0 at the
/// start of the first frame's air time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTimes {
    /// Start of the transition to the frame.
    pub drive_s: f64,
    /// Start of the frame's air time, which is the end of the transition.
    pub air_s: f64,
    /// End of the frame's air time; infinite while the frame waits for GO.
    pub end_s: f64,
}

impl FrameTimes {
    /// Times of a frame whose transition lasts `drive_s` and whose air time lasts `air_s` seconds. `end_s` is the end of
    /// the previous frame; `None` for the first frame, whose air time begins at 0.
    pub fn after(end_s: Option<f64>, drive_s: f64, air_s: f64) -> Self {
        let begin_s = end_s.unwrap_or(-drive_s);
        Self { drive_s: begin_s, air_s: begin_s + drive_s, end_s: begin_s + drive_s + air_s }
    }
}
