//! Fits shows to another number of robots.

use lightbots_api::{FitAnswer, MakeRemark};
use lightbots_exchange::LIGHTBOTS;

use crate::answer;

/// Fits all frames of a show to the number `robots` of robots. `show` has the bytes of a show file in any format.
pub fn fit_answer(show: &[u8], robots: usize) -> FitAnswer {
    fitted(show, robots).unwrap_or_else(|error| FitAnswer { error: Some(error), ..FitAnswer::default() })
}

fn fitted(show: &[u8], robots: usize) -> Result<FitAnswer, MakeRemark> {
    let mut show = lightbots_exchange::read(show, None).map_err(|error| answer::reading(&error))?.show;
    let notes = lightbots_make::fit_show(&mut show, robots).map_err(answer::drawing)?;
    let written = LIGHTBOTS.write(&show, None);
    let document = serde_json::from_slice(&written.bytes).map_err(|error| MakeRemark {
        code: "not-json".to_owned(),
        message: format!("the fitted show is not JSON: {error}; report this to the makers of LightBots"),
    })?;
    Ok(FitAnswer { show: Some(document), notes: answer::notes(&notes), error: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOTS: &str = r##"{"lightbots": 1, "frames": [{"name": "Dots", "air_time_s": 2, "pixels": [
        {"id": 0, "place": [0.5, 0], "color": "#ffa500"}, {"id": 1, "place": [0, 0], "color": "#ffa500"}]}]}"##;

    #[test]
    fn a_show_is_fitted_to_more_robots() {
        let answer = fit_answer(DOTS.as_bytes(), 5);
        let pixels = &answer.show.unwrap()["frames"][0]["pixels"];
        assert_eq!(pixels.as_array().unwrap().len(), 5);
        assert_eq!(answer.error, None);
    }

    #[test]
    fn what_is_no_show_and_too_many_robots_are_errors_in_the_answer() {
        assert_eq!(
            fit_answer(b"{", 5).error.unwrap().code,
            lightbots_exchange::read(b"{", None).unwrap_err().code
        );
        assert_eq!(fit_answer(DOTS.as_bytes(), 9_999).error.unwrap().code, "too-many-robots");
    }
}
