//! Plans whole shows from their starting places, and remembers the latest plan.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use lightbots_api as api;
use lightbots_api::plan_document;
use lightbots_base::{Rgb, StateHash};
use lightbots_plan::{Cancelled, ShowOptions, ShowPlan};
use lightbots_show::{Assets, Issue, Issues, Show, starting_places};

use crate::threads::Threads;

/// Plans a show from its starting places. `found` has the issues of reading and validating it.
pub fn plan(show: &Show, found: &Issues) -> (ShowPlan, api::Plan) {
    // This planning is never cancelled.
    plan_unless(show, found, &|| false).unwrap_or_default()
}

/// Plans a show as [`plan`] does, but stops with an error as soon as `is_cancelled` returns `true`.
pub fn plan_unless(
    show: &Show,
    found: &Issues,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<(ShowPlan, api::Plan), Cancelled> {
    let began = Instant::now();
    let plan = made(show, is_cancelled)?;
    let document = document(show, found, &plan, began);
    Ok((plan, document))
}

fn made(show: &Show, is_cancelled: &dyn Fn() -> bool) -> Result<ShowPlan, Cancelled> {
    lightbots_plan::show_with(&Threads, show, &starting_places(show), &ShowOptions::default(), is_cancelled)
}

fn document(show: &Show, found: &Issues, plan: &ShowPlan, began: Instant) -> api::Plan {
    let plan_ms = began.elapsed().as_secs_f64() * 1e3;
    let found: Issues = found.iter().cloned().chain(lightbots_lighting::flashes_of(show, plan)).collect();
    plan_document(plan, &found, plan_ms)
}

/// The latest plan. It is used again for a show that differs only in what drives do not depend on, such as light,
/// colours, music or its name. A new name of a frame leads to a new plan.
#[derive(Debug, Default)]
pub struct LastPlan(Mutex<Option<(Show, Arc<ShowPlan>)>>);

impl LastPlan {
    /// Plans a show as [`plan_unless`] does, or takes the latest plan if robots would drive as in that one.
    pub fn plan_unless(
        &self,
        show: &Show,
        found: &Issues,
        is_cancelled: &dyn Fn() -> bool,
    ) -> Result<api::Plan, Cancelled> {
        let began = Instant::now();
        let driven = driven(show);
        let known = self.last().as_ref().filter(|(other, _)| *other == driven).map(|(_, plan)| plan.clone());
        let plan = match known {
            Some(plan) => plan,
            None => Arc::new(made(show, is_cancelled)?),
        };
        *self.last() = Some((driven, plan.clone()));
        Ok(document(show, found, &plan, began))
    }

    fn last(&self) -> std::sync::MutexGuard<'_, Option<(Show, Arc<ShowPlan>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Writes into a hash.
struct Hashed(StateHash);

impl io::Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.bytes(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Returns a hash of a show without the parts that robots' drives do not depend on; the names of frames are hashed,
/// too. It takes long for a large show, so it must not run in a task that others wait for.
pub fn drives_hash(show: &Show) -> u64 {
    let mut hashed = Hashed(StateHash::new());
    // Neither serialising a show nor hashing it fails.
    let _ = serde_json::to_writer(io::BufWriter::new(&mut hashed), &driven(show));
    hashed.0.finish()
}

/// Returns a copy of the show without the parts that robots' drives surely do not depend on. All other fields are kept, also
/// the names of frames.
fn driven(show: &Show) -> Show {
    let mut driven = Show {
        name: String::new(),
        music: None,
        assets: Assets::default(),
        beats: None,
        sections: Vec::new(),
        markers: Vec::new(),
        cues: Vec::new(),
        layers: Vec::new(),
        ..show.clone()
    };
    for frame in &mut driven.frames {
        (frame.id, frame.sources) = (None, Vec::new());
        for pixel in &mut frame.pixels {
            (pixel.color, pixel.part, pixel.group) = (Rgb::BLACK, None, None);
        }
    }
    driven
}

/// Returns the answer to clients for a show whose planning took too long: issues, and no part of a plan.
pub fn cut_off(found: &Issues, budget: Duration) -> api::Plan {
    let message = format!(
        "planning took longer than {} s and was cut off: check the show on the command line, make it smaller, or start \
         lightbots with a longer --plan-budget",
        budget.as_secs()
    );
    let issues =
        found.iter().chain([&Issue::error("planning-cut-off", message)]).map(api::Issue::from).collect();
    api::Plan { issues, ..api::Plan::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Vec2;
    use lightbots_show::{Frame, Layer, LayerSpan, Pixel};

    fn show() -> Show {
        let pixel = Pixel { id: 0, at: Vec2::new(0.5, 0.0), ..Pixel::default() };
        let frame = Frame { name: "A".into(), air_time_s: 1.0, pixels: vec![pixel], ..Frame::default() };
        Show { frames: vec![frame], ..Show::default() }
    }

    #[test]
    fn only_a_change_of_the_drives_is_planned_again() {
        let last = LastPlan::default();
        let plan = |show: &Show, gives_up: bool| last.plan_unless(show, &Vec::new(), &|| gives_up);
        let first = plan(&show(), false).expect("it is not given up");
        assert_eq!(first.transitions.len(), 1);
        // Planning is cancelled at once here, so that a result can only be a remembered one.
        let mut lit = show();
        let (name, span, settings) = (String::new(), LayerSpan::Show, Vec::new());
        lit.layers.push(Layer { kind: "fire".into(), name, span, settings });
        lit.frames[0].pixels[0].color = Rgb::new(9, 9, 9);
        lit.name = "Fire".into();
        assert_eq!(plan(&lit, true).expect("it is known").transitions, first.transitions);
        let mut moved = lit.clone();
        moved.frames[0].pixels[0].at.x = 0.6;
        assert!(plan(&moved, true).is_err());
        moved.frames[0].pixels[0].at.x = 0.5;
        moved.frames[0].transition_s = Some(30.0);
        assert!(plan(&moved, true).is_err());
    }
}
