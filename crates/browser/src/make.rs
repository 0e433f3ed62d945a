//! Makes frames from their sources.

use lightbots_api::{MadePixel, MadeReadability, MakeAnswer, MakeQuality, MakeRemark, MakeRequest};
use lightbots_draw::{PictureFloor, Quality, READABLE};
use lightbots_make::{MadeFrame, enough_for, make_frame, picture_floor};
use lightbots_show::{Frame, Pixel};

use crate::answer;

/// Makes a frame from its source. `request` is a `MakeRequest` as JSON. `asset` has the bytes of the source's file; `None`:
/// the source has no file.
pub fn make_answer(request: &str, asset: Option<&[u8]>) -> MakeAnswer {
    made(request, asset).unwrap_or_else(|error| MakeAnswer { error: Some(error), ..MakeAnswer::default() })
}

/// A request to make a frame, read from JSON.
pub(crate) struct FrameWish {
    /// The frame with its source.
    pub frame: Frame,
    pub floor: PictureFloor,
    pub robots: usize,
    pub quality: Quality,
}

impl FrameWish {
    /// Reads a `MakeRequest` as JSON. The frame is the first frame of the request's show.
    pub(crate) fn read(request: &str) -> Result<Self, MakeRemark> {
        let request: MakeRequest = answer::request(request)?;
        let document = request.show.to_string();
        let show = lightbots_exchange::read(document.as_bytes(), None)
            .map_err(|error| answer::reading(&error))?
            .show;
        let floor = picture_floor(&show.stage);
        let frame = show.frames.into_iter().next();
        let frame = frame.ok_or_else(|| remark("no-frame", "the show has no frame; add one"))?;
        let quality = match request.quality {
            MakeQuality::Quick => Quality::Quick,
            MakeQuality::Full => Quality::Full,
        };
        Ok(Self { frame, floor, robots: request.robots, quality })
    }
}

fn made(request: &str, asset: Option<&[u8]>) -> Result<MakeAnswer, MakeRemark> {
    let FrameWish { frame, floor, robots, quality } = FrameWish::read(request)?;
    let made = make_frame(&frame, asset, &floor, robots, quality, &[]).map_err(answer::drawing)?;
    let readability = readability(&made);
    let counted = quality == Quality::Full && readability.is_some_and(|read| !read.readable);
    let enough = counted.then(|| enough(&frame, asset)).flatten();
    Ok(full(&made, readability, enough))
}

/// Returns how well the lights show the source. `None` if the source is itself an arrangement of lights, such as a grid.
pub(crate) fn readability(made: &MadeFrame) -> Option<MadeReadability> {
    made.readability.map(|read| MadeReadability {
        correlation: read.correlation,
        symmetry: read.symmetry,
        readable: read.correlation >= READABLE,
    })
}

/// Returns the answer for a made frame. `enough` is the number of robots with which the source would be readable, if known.
pub(crate) fn full(
    made: &MadeFrame,
    readability: Option<MadeReadability>,
    enough: Option<usize>,
) -> MakeAnswer {
    MakeAnswer {
        pixels: made.frame.pixels.iter().map(pixel).collect(),
        size_m: made.size_m,
        closest_m: made.closest_m.is_finite().then_some(made.closest_m),
        readability,
        enough,
        notes: answer::notes(&made.notes),
        error: None,
    }
}

/// Returns the number of robots with which the frame's first source would be readable; `None`: unknown. Errors are ignored,
/// because the frame was already made from the source.
fn enough(frame: &Frame, asset: Option<&[u8]>) -> Option<usize> {
    enough_for(frame.sources.first()?, asset).ok().flatten()
}

fn pixel(pixel: &Pixel) -> MadePixel {
    MadePixel {
        id: pixel.id,
        place: [pixel.at.x, pixel.at.y],
        color: format!("#{:06x}", pixel.color.number()),
        robot: pixel.robot.clone(),
        part: pixel.part.as_ref().map(|part| part.name.clone()),
    }
}

/// Makes an error with a message for people.
pub(crate) fn remark(code: &str, what: impl ToString) -> MakeRemark {
    MakeRemark { code: code.to_owned(), message: what.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(source: &str, robots: usize, quality: &str) -> String {
        let frame = format!(r#"{{"name": "A", "air_time_s": 1, "pixels": [], "sources": [{source}]}}"#);
        let show =
            format!(r#"{{"lightbots": 2, "stage": {{"width_m": 4, "depth_m": 4}}, "frames": [{frame}]}}"#);
        format!(r#"{{"show": {show}, "robots": {robots}, "quality": "{quality}"}}"#)
    }

    const HI: &str = r#"{"kind": "text", "seed": 1, "settings": {"text": "HI"}}"#;

    #[test]
    fn a_word_becomes_pixels_that_know_their_letters() {
        for quality in ["quick", "full"] {
            let answer = make_answer(&request(HI, 30, quality), None);
            assert_eq!(answer.error, None);
            assert_eq!(answer.pixels.len(), 30);
            assert!(answer.pixels.iter().all(|pixel| pixel.part.is_some()));
            assert!(answer.readability.unwrap().readable, "{quality}");
            assert_eq!(answer.enough, None);
        }
    }

    #[test]
    fn with_too_few_robots_a_full_result_says_how_many_would_do() {
        let full = make_answer(&request(HI, 6, "full"), None);
        assert!(!full.readability.unwrap().readable);
        assert!((7..=30).contains(&full.enough.unwrap()), "{:?}", full.enough);
        assert_eq!(make_answer(&request(HI, 6, "quick"), None).enough, None);
    }

    #[test]
    fn a_file_is_drawn_and_a_missing_file_is_an_error_in_the_answer() {
        let request = request(r#"{"kind": "svg"}"#, 20, "full");
        let svg = br#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="9" height="9"/></svg>"#;
        assert_eq!(make_answer(&request, Some(svg)).pixels.len(), 20);
        assert_eq!(make_answer(&request, None).error.unwrap().code, "asset-missing");
        assert!(make_answer(&request, Some(b"no drawing")).error.is_some());
    }

    #[test]
    fn what_is_no_request_is_an_error_in_the_answer() {
        assert_eq!(make_answer("{", None).error.unwrap().code, "bad-request");
        assert!(make_answer(r#"{"show": 1, "robots": 3, "quality": "full"}"#, None).error.is_some());
        assert!(make_answer(&request(HI, 0, "full"), None).error.is_some());
        assert!(make_answer(&request(HI, 99_999, "full"), None).error.is_some());
        let shape = r#"{"kind": "shape", "settings": {"shape": "cloud"}}"#;
        assert_eq!(make_answer(&request(shape, 9, "full"), None).error.unwrap().code, "unknown-shape");
    }
}
