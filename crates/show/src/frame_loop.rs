//! Frames that a show repeats until GO.

use std::collections::BTreeMap;

use crate::{Cue, CuePlace, Issue, Issues, Show, excerpt, frame_label};

/// Frames that a show repeats until GO. The show has a cue at the last of these frames, and the cue names the first
/// one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameLoop {
    /// The first frame, counted from 0.
    pub first: usize,
    /// The last frame, counted from 0 and included; not less than `first`.
    pub last: usize,
}

impl FrameLoop {
    /// Whether the loop contains the frame with the index `frame`, counted from 0.
    pub fn has(&self, frame: usize) -> bool {
        (self.first..=self.last).contains(&frame)
    }
}

/// The valid loops of a show in playing order. No frame is in two loops. If several cues name a frame, the first of
/// them counts. A cue with an invalid loop gives no loop: [`validate`](crate::validate()) warns about it, and the show
/// waits for GO at the cue's frame instead.
pub fn frame_loops(show: &Show) -> Vec<FrameLoop> {
    examined(show).0
}

/// The valid loops of a show in playing order, and a warning for each invalid loop.
pub(crate) fn examined(show: &Show) -> (Vec<FrameLoop>, Issues) {
    let (mut loops, mut issues) = (Vec::new(), Issues::new());
    let (mut cues, mut places) = (BTreeMap::<&str, &Cue>::new(), BTreeMap::<&str, usize>::new());
    for cue in &show.cues {
        if let CuePlace::Frame(id) = &cue.at {
            cues.entry(id).or_insert(cue);
        }
    }
    for (index, frame) in show.frames.iter().enumerate() {
        if let Some(id) = &frame.id {
            places.entry(id).or_insert(index);
        }
    }
    for (last, frame) in show.frames.iter().enumerate() {
        let Some(from) = frame.id.as_deref().and_then(|id| cues.get(id)?.loop_from.as_deref()) else {
            continue;
        };
        match loop_to(last, places.get(from).copied(), loops.last()) {
            Ok(found) => loops.push(found),
            Err((code, why)) => {
                let what = format!(
                    "{}: it repeats from the frame \"{}\", {why}; until then it waits for GO and does not repeat",
                    frame_label(last, &frame.name),
                    excerpt(from)
                );
                issues.push(Issue::warning(code, what).in_frame(last));
            }
        }
    }
    (loops, issues)
}

/// Returns the loop from the frame `first` to the frame `last`, both counted from 0. `first` is `None` if no frame has
/// the id that the cue names. `before` is the last valid loop in playing order. If the loop is invalid, returns the
/// code of an issue and the reason.
fn loop_to(
    last: usize,
    first: Option<usize>,
    before: Option<&FrameLoop>,
) -> Result<FrameLoop, (&'static str, &'static str)> {
    match first {
        None => Err(("unknown-loop-frame", "which is not there; choose another frame")),
        Some(first) if first > last => {
            Err(("bad-loop", "which comes after it; choose this frame or an earlier one"))
        }
        Some(first) if before.is_some_and(|before| first <= before.last) => {
            Err(("overlapping-loops", "which leads into another loop; choose a frame after that loop"))
        }
        Some(first) => Ok(FrameLoop { first, last }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Frame;

    /// Five frames with the ids `f0` to `f4`. `loops`: for each cue, the index of its frame and the id of the loop's
    /// first frame.
    fn show(loops: &[(usize, &str)]) -> Show {
        let frame = |number: usize| Frame { id: Some(format!("f{number}")), ..Frame::default() };
        let cue = |&(last, from): &(usize, &str)| Cue {
            name: String::new(),
            at: CuePlace::Frame(format!("f{last}")),
            loop_from: Some(from.into()),
        };
        Show { frames: (0..5).map(frame).collect(), cues: loops.iter().map(cue).collect(), ..Show::default() }
    }

    fn loops(of: &[(usize, &str)]) -> Vec<(usize, usize)> {
        frame_loops(&show(of)).iter().map(|one| (one.first, one.last)).collect()
    }

    #[test]
    fn loops_are_in_playing_order() {
        assert_eq!(loops(&[(3, "f3"), (2, "f1"), (0, "f0")]), [(0, 0), (1, 2), (3, 3)]);
        assert!(loops(&[]).is_empty());
        let frames = FrameLoop { first: 1, last: 2 };
        assert_eq!([0, 1, 2, 3].map(|frame| frames.has(frame)), [false, true, true, false]);
    }

    #[test]
    fn a_loop_that_is_not_possible_is_none_and_says_why() {
        assert_eq!(loops(&[(2, "gone"), (1, "f3"), (3, "f0"), (4, "f2")]), [(0, 3)]);
        let issues = examined(&show(&[(2, "gone"), (1, "f3"), (3, "f0"), (4, "f2")])).1;
        let found: Vec<_> = issues.iter().map(|issue| (issue.frame, issue.code.as_str())).collect();
        let wanted = [(Some(1), "bad-loop"), (Some(2), "unknown-loop-frame"), (Some(4), "overlapping-loops")];
        assert_eq!(found, wanted);
        let said = "frame 3: it repeats from the frame \"gone\", which is not there; choose another frame; \
                    until then it waits for GO and does not repeat";
        assert_eq!(issues[1].message, said);
        assert!(!issues.iter().any(Issue::is_error));
    }
}
