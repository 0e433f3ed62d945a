//! The bounded list of issues that validation fills.

use std::collections::BTreeSet;

use crate::{Issue, Issues, Show, frame_label};

/// A bounded list of issues: at most `MOST_OF_A_KIND` of a kind in a frame, and `MOST` in total.
#[derive(Default)]
pub(super) struct Findings {
    pub issues: Issues,
}

impl Findings {
    /// Largest number of issues of one kind in one frame that get a line of their own. One line sums up the others, so
    /// that people see all kinds on one screen.
    const MOST_OF_A_KIND: usize = 8;
    /// Largest number of issues in total. One more issue says that there are more. Bounds the answer for a show that is
    /// broken everywhere.
    const MOST: usize = 1_000;

    /// Adds an issue, if there is room for it.
    pub fn add(&mut self, issue: Issue) {
        if self.issues.len() < Self::MOST {
            self.issues.push(issue);
        } else if self.issues.len() == Self::MOST {
            self.issues.push(Issue::error("more-issues", "there are more issues; mend these first"));
        }
    }

    /// Adds an error of the whole show.
    pub fn show(&mut self, code: &str, message: impl Into<String>) {
        self.add(Issue::error(code, message));
    }

    /// Adds an error of a frame. The label of the frame is put before the message.
    pub fn frame(&mut self, show: &Show, frame: usize, code: &str, message: &str) {
        self.add(Issue::error(code, format!("{}: {message}", label(show, frame))).in_frame(frame));
    }

    /// Adds errors of one kind about pixels of a frame: the first few, then one line with the number and ids of the
    /// rest.
    pub fn pixels(&mut self, show: &Show, frame: usize, code: &str, found: Vec<(Vec<u32>, String)>) {
        let rest = found.get(Self::MOST_OF_A_KIND..).unwrap_or_default();
        let more = rest.len();
        let of_rest: BTreeSet<u32> = rest.iter().flat_map(|(pixels, _)| pixels.iter().copied()).collect();
        for (pixels, message) in found.into_iter().take(Self::MOST_OF_A_KIND) {
            let message = format!("{}, {message}", label(show, frame));
            self.add(Issue::error(code, message).in_frame(frame).with_pixels(pixels));
        }
        if more > 0 {
            let message = format!("{}: {more} more like this", label(show, frame));
            self.add(Issue::error(code, message).in_frame(frame).with_pixels(of_rest));
        }
    }
}

fn label(show: &Show, frame: usize) -> String {
    frame_label(frame, &show.frames[frame].name)
}
