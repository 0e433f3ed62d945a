//! When a frame is driven to and shown.

/// When a frame is driven to, reached and left, seconds of show time: 0 is the start of the first frame's air time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTimes {
    /// The transition to the frame begins.
    pub drive_s: f64,
    /// Its air time begins.
    pub air_s: f64,
    /// Its air time ends; infinite while the frame waits for GO.
    pub end_s: f64,
}

impl FrameTimes {
    /// The frame after one that ends at `end_s`; for the first frame, its air time begins at 0.
    pub fn after(end_s: Option<f64>, drive_s: f64, air_s: f64) -> Self {
        let begin_s = end_s.unwrap_or(-drive_s);
        Self { drive_s: begin_s, air_s: begin_s + drive_s, end_s: begin_s + drive_s + air_s }
    }
}
