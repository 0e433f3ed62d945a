//! What is wrong with a show, before anything is planned.

mod fleet;
mod frame;
mod stage;

use std::collections::BTreeSet;

use lightbots_base::Vec2;

use crate::{Issue, Issues, Show, frame_label};

/// Most frames of a show.
pub const MAX_FRAMES: usize = 10_000;
/// Most pixels of a frame, and robots of a fleet.
pub const MAX_PIXELS: usize = 20_000;
/// Most obstacles of a stage.
pub const MAX_OBSTACLES: usize = 1_000;
/// What two rims must leave between them for a plan to be proven against noise, metres: pixels that touch at 54 mm
/// must be 57 mm apart.
pub const PROVABLE_GAP_M: f64 = 0.003;

/// What is wrong with a show, in the order of its frames; empty for a show that is fit to be planned. Finds the same
/// for the same show, and takes any show, however broken.
pub fn validate(show: &Show) -> Issues {
    let mut findings = Findings::default();
    let is_sound = stage::check(&show.stage, &mut findings);
    fleet::check(show, is_sound, &mut findings);
    for index in 0..show.frames.len().min(MAX_FRAMES) {
        frame::check(show, index, is_sound, &mut findings);
    }
    findings.issues
}

/// Issues found, with a bound on how many: of each kind some in a frame, and so many in all.
#[derive(Default)]
struct Findings {
    issues: Issues,
}

impl Findings {
    /// Issues of one kind that are spelled out in one frame.
    const MOST_OF_A_KIND: usize = 8;
    /// Issues in all.
    const MOST: usize = 1_000;

    fn add(&mut self, issue: Issue) {
        if self.issues.len() < Self::MOST {
            self.issues.push(issue);
        } else if self.issues.len() == Self::MOST {
            self.issues.push(Issue::error("more-issues", "there are more issues; mend these first"));
        }
    }

    /// Adds an issue of the show.
    fn show(&mut self, code: &str, message: impl Into<String>) {
        self.add(Issue::error(code, message));
    }

    /// Adds an issue of a frame, whose label goes before the message.
    fn frame(&mut self, show: &Show, frame: usize, code: &str, message: &str) {
        self.add(Issue::error(code, format!("{}: {message}", label(show, frame))).in_frame(frame));
    }

    /// Adds issues of one kind about pixels of a frame: the first few, then how many more there are, and about which.
    fn pixels(&mut self, show: &Show, frame: usize, code: &str, found: Vec<(Vec<u32>, String)>) {
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

/// A number of a file as messages show it: those that no show needs with their exponent, so that lines stay short.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-4..1e7).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

/// A place of a file as messages show it, metres.
fn place(at: Vec2) -> String {
    let metres = |value: f64| if value.abs() < 1e7 { format!("{value:.3}") } else { number(value) };
    format!("{}, {}", metres(at.x), metres(at.y))
}

/// Millimetres with one decimal, as messages state gaps.
fn millimetres(metres: f64) -> String {
    format!("{:.1} mm", metres * 1e3)
}
