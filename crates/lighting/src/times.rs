//! When a frame is driven to and shown.

/// When a frame is driven to, reached and left, seconds of show time: 0 is the start of the first frame's air time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTimes {
    /// Start of the transition to the frame.
    pub drive_s: f64,
    /// Start of its air time.
    pub air_s: f64,
    /// End of its air time; infinite while the frame waits for GO.
    pub end_s: f64,
}

impl FrameTimes {
    /// Times of a frame with a drive of `drive_s` and an air time of `air_s` seconds, after a frame that ends at
    /// `end_s`. `None`: it is the first frame, whose air time begins at 0.
    pub fn after(end_s: Option<f64>, drive_s: f64, air_s: f64) -> Self {
        let begin_s = end_s.unwrap_or(-drive_s);
        Self { drive_s: begin_s, air_s: begin_s + drive_s, end_s: begin_s + drive_s + air_s }
    }
}
