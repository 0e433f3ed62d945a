//! The bounded list of issues that validation fills.

use std::collections::BTreeSet;

use crate::{Issue, Issues, Show, frame_label};

/// A bounded list of issues. It has at most `MOST` issues and one that sums up the others. The same holds for
/// `MOST_OF_A_KIND` issues of one kind about the pixels of a frame.
#[derive(Default)]
pub(super) struct Findings {
    pub issues: Issues,
}

impl Findings {
    /// Largest number of issues of one kind about the pixels of a frame that are listed one by one. One more issue sums up
    /// the others, so that people see issues of all kinds on one screen.
    const MOST_OF_A_KIND: usize = 8;
    /// Largest number of issues in total. After them, one issue says that there are more. Bounds the list for a show that
    /// is broken everywhere.
    const MOST: usize = 1_000;

    /// Adds an issue. If there are [`Self::MOST`] already, one further issue says instead that there are more. That
    /// issue is an error if any of those left out is an error.
    pub fn add(&mut self, issue: Issue) {
        if self.issues.len() < Self::MOST {
            self.issues.push(issue);
            return;
        }
        let is_said = self.issues.len() > Self::MOST;
        if is_said && !issue.is_error() {
            return;
        }
        self.issues.truncate(Self::MOST);
        self.issues.push(if issue.is_error() {
            Issue::error("more-issues", "there are more issues; mend these first")
        } else {
            Issue::warning("more-issues", "there are more warnings; look at these first")
        });
    }

    /// Adds an error of the whole show.
    pub fn show(&mut self, code: &str, message: impl Into<String>) {
        self.add(Issue::error(code, message));
    }

    /// Adds an error of a frame. The label of the frame is put before the message.
    pub fn frame(&mut self, show: &Show, frame: usize, code: &str, message: &str) {
        self.add(Issue::error(code, format!("{}: {message}", label(show, frame))).in_frame(frame));
    }

    /// Adds errors of the kind `code` about pixels of a frame. `found` has ids of pixels and a message for each error. The
    /// first [`Self::MOST_OF_A_KIND`] are added as they are. One more error has the number of the others and all their
    /// pixels.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_show_with_very_many_warnings_is_valid_and_one_error_among_those_left_out_is_not_lost() {
        let mut findings = Findings::default();
        (0..1_500).for_each(|_| findings.add(Issue::warning("odd", "odd")));
        assert_eq!(findings.issues.len(), 1_001);
        assert!(!findings.issues.iter().any(Issue::is_error));
        findings.show("wrong", "wrong");
        (0..9).for_each(|_| findings.add(Issue::warning("odd", "odd")));
        assert_eq!(findings.issues.len(), 1_001);
        assert!(findings.issues.last().is_some_and(|last| last.is_error() && last.code == "more-issues"));
    }
}
