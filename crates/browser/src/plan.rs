//! Plans shows.

use lightbots_api::{MakeQuality, MakeRemark, Plan, PlanAnswer, PlanningRequest, plan_document};
use lightbots_plan::ShowOptions;
use lightbots_show::{starting_places, validate};

use crate::answer;

/// Plans a show from its starting places. `request` is a `PlanningRequest` as JSON.
pub fn plan_answer(request: &str) -> PlanAnswer {
    match planned(request) {
        Ok(plan) => PlanAnswer { plan: Some(plan), error: None },
        Err(error) => PlanAnswer { plan: None, error: Some(error) },
    }
}

fn planned(request: &str) -> Result<Plan, MakeRemark> {
    let request: PlanningRequest = answer::request(request)?;
    let document = request.show.to_string();
    let loaded =
        lightbots_exchange::read(document.as_bytes(), None).map_err(|error| answer::reading(&error))?;
    let found = [loaded.issues, validate(&loaded.show)].concat();
    let options = ShowOptions { as_preview: request.quality == MakeQuality::Quick, ..ShowOptions::default() };
    let starts = starting_places(&loaded.show);
    Ok(plan_document(&lightbots_plan::show(&loaded.show, &starts, &options), &found, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: [&str; 3] = [
        r##"{"id": 0, "place": [0.5, 0], "color": "#ffa500"}, {"id": 1, "place": [0, 0], "color": "#ffa500"}"##,
        r##"{"id": 0, "place": [0.5, 1], "color": "#ffa500"}, {"id": 1, "place": [0, 1], "color": "#ffa500"}"##,
        r##"{"id": 0, "place": [0.01, 0], "color": "#ffa500"}, {"id": 1, "place": [0, 0], "color": "#ffa500"}"##,
    ];

    fn request(frames: [usize; 2], quality: &str) -> String {
        let frame =
            |index: usize| format!(r#"{{"name": "A", "air_time_s": 2, "pixels": [{}]}}"#, PIXELS[index]);
        let frames = frames.map(frame).join(",");
        format!(r#"{{"show": {{"lightbots": 2, "frames": [{frames}]}}, "quality": "{quality}"}}"#)
    }

    #[test]
    fn a_plan_is_the_one_that_the_planner_makes_from_the_starting_places() {
        let text = request([0, 1], "full");
        let plan = plan_answer(&text).plan.unwrap();
        let document = &serde_json::from_str::<serde_json::Value>(&text).unwrap()["show"];
        let show = lightbots_exchange::read(document.to_string().as_bytes(), None).unwrap().show;
        let made = lightbots_plan::show(&show, &starting_places(&show), &ShowOptions::default());
        assert!(plan.ok);
        assert_eq!(plan, plan_document(&made, &validate(&show), 0.0));
    }

    #[test]
    fn a_quick_plan_has_proven_paths_too() {
        let [quick, full] =
            ["quick", "full"].map(|quality| plan_answer(&request([0, 1], quality)).plan.unwrap());
        assert_eq!(quick.closest_m, full.closest_m);
        assert_eq!(quick.transitions.len(), 2);
    }

    #[test]
    fn what_cannot_be_planned_is_said() {
        assert_eq!(plan_answer("{").error.unwrap().code, "bad-request");
        assert!(plan_answer(r#"{"show": 1, "quality": "full"}"#).error.is_some());
        let plan = plan_answer(&request([0, 2], "quick")).plan.unwrap();
        assert!(!plan.ok && !plan.issues.is_empty());
    }
}
