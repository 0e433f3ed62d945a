//! Moves pictures as a whole.

use lightbots_api::{MakeRemark, MovedAnswer, MovedPixel};

use crate::answer;

/// Returns the places of the first frame's pixels after the motion of the second frame. `show` has the bytes of a show file
/// with two frames.
pub fn moved_answer(show: &[u8]) -> MovedAnswer {
    match moved(show) {
        Ok(pixels) => MovedAnswer { pixels, error: None },
        Err(error) => MovedAnswer { pixels: Vec::new(), error: Some(error) },
    }
}

fn moved(show: &[u8]) -> Result<Vec<MovedPixel>, MakeRemark> {
    let show = lightbots_exchange::read(show, None).map_err(|error| answer::reading(&error))?.show;
    let wrong = lightbots_show::validate(&show).into_iter().find(|issue| issue.code == "bad-motion");
    if let Some(issue) = wrong {
        return Err(MakeRemark { code: issue.code, message: issue.message });
    }
    let [before, frame] = &show.frames[..] else {
        return Err(none("a motion leads from one frame to another; send two"));
    };
    let motion = frame.motion.as_ref().ok_or_else(|| none("the second frame has no motion; choose one"))?;
    let places = lightbots_plan::moved(motion, before);
    Ok(places.into_iter().map(|(id, at)| MovedPixel { id, place: [at.x, at.y] }).collect())
}

fn none(message: &str) -> MakeRemark {
    MakeRemark { code: "no-motion".to_owned(), message: message.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn show(motion: &str) -> String {
        let pixels = r##"[{"id": 3, "place": [0.5, 0], "color": "#ffa500"}]"##;
        format!(
            r#"{{"lightbots": 2, "frames": [{{"air_time_s": 2, "pixels": {pixels}}},
                {{"air_time_s": 2, {motion} "pixels": {pixels}}}]}}"#
        )
    }

    #[test]
    fn a_picture_turns() {
        let answer =
            moved_answer(show(r#""motion": {"kind": "turn", "turn": 1.5707963267948966},"#).as_bytes());
        let [pixel] = &answer.pixels[..] else { panic!("{answer:?}") };
        assert_eq!((pixel.id, answer.error), (3, None));
        assert!(pixel.place[0].abs() < 1e-9 && (pixel.place[1] - 0.5).abs() < 1e-9);
    }

    #[test]
    fn what_cannot_be_moved_says_why() {
        let code = |text: &str| moved_answer(text.as_bytes()).error.unwrap().code;
        assert_eq!(code("{"), lightbots_exchange::read(b"{", None).unwrap_err().code);
        assert_eq!(code(&show("")), "no-motion");
        assert_eq!(code(&show(r#""motion": {"kind": "turn", "turn": 1e9},"#)), "bad-motion");
        assert_eq!(code(r#"{"lightbots": 1, "frames": []}"#), "no-motion");
    }
}
