//! Letters and digits as strokes.

use lightbots_base::Vec2;

use super::stroke::Stroke;

/// Width of a letter whose height is 1.
pub const WIDTH: f64 = 0.62;

/// A word as strokes, centred on `centre`, letters `height_m` high and `gap_m` apart.
pub fn word(text: &str, centre: Vec2, height_m: f64, gap_m: f64) -> Vec<Stroke> {
    let step_m = WIDTH * height_m + gap_m;
    let left_m = (text.len() as f64 - 1.0) / 2.0 * step_m;
    let place = |nth: usize| centre + Vec2::new(nth as f64 * step_m - left_m, 0.0);
    text.chars().enumerate().flat_map(|(nth, char)| letter(char, place(nth), height_m)).collect()
}

/// One letter centred on `centre`.
pub fn letter(char: char, centre: Vec2, height_m: f64) -> Vec<Stroke> {
    let place = |point: Vec2| centre + (point - Vec2::new(WIDTH / 2.0, 0.5)) * height_m;
    strokes(char).into_iter().map(|stroke| stroke.into_iter().map(place).collect()).collect()
}

/// The strokes of a letter in a box from 0 to [`WIDTH`] and from 0 to 1.
fn strokes(char: char) -> Vec<Stroke> {
    let w = WIDTH;
    match char {
        'A' => vec![line(&[(0.0, 0.0), (w / 2.0, 1.0), (w, 0.0)]), line(&[(w * 0.2, 0.4), (w * 0.8, 0.4)])],
        'B' => vec![
            line(&[(0.0, 0.0), (0.0, 1.0)]),
            bow(&[(0.0, 1.0)], arc(w * 0.5, 0.75, w * 0.4, 0.25, 90.0, -90.0), &[(0.0, 0.5)]),
            bow(&[(0.0, 0.5)], arc(w * 0.5, 0.25, w * 0.5, 0.25, 90.0, -90.0), &[(0.0, 0.0)]),
        ],
        'C' => vec![arc(w / 2.0, 0.5, w / 2.0, 0.5, 45.0, 315.0)],
        'D' => {
            vec![bow(&[(0.0, 0.0), (0.0, 1.0)], arc(w * 0.4, 0.5, w * 0.6, 0.5, 90.0, -90.0), &[(0.0, 0.0)])]
        }
        'E' => vec![line(&[(w, 1.0), (0.0, 1.0), (0.0, 0.0), (w, 0.0)]), line(&[(0.0, 0.5), (w * 0.8, 0.5)])],
        'F' => vec![line(&[(w, 1.0), (0.0, 1.0), (0.0, 0.0)]), line(&[(0.0, 0.5), (w * 0.8, 0.5)])],
        'G' => vec![bow(&[], arc(w / 2.0, 0.5, w / 2.0, 0.5, 45.0, 345.0), &[(w, 0.45), (w * 0.55, 0.45)])],
        'H' => {
            vec![line(&[(0.0, 0.0), (0.0, 1.0)]), line(&[(w, 0.0), (w, 1.0)]), line(&[(0.0, 0.5), (w, 0.5)])]
        }
        'I' => vec![line(&[(w / 2.0, 0.0), (w / 2.0, 1.0)])],
        'L' => vec![line(&[(0.0, 1.0), (0.0, 0.0), (w, 0.0)])],
        'N' => vec![line(&[(0.0, 0.0), (0.0, 1.0), (w, 0.0), (w, 1.0)])],
        'O' => vec![arc(w / 2.0, 0.5, w / 2.0, 0.5, 90.0, 450.0)],
        'R' => vec![
            bow(&[(0.0, 0.0), (0.0, 1.0)], arc(w * 0.5, 0.75, w * 0.5, 0.25, 90.0, -90.0), &[(0.0, 0.5)]),
            line(&[(w * 0.45, 0.5), (w, 0.0)]),
        ],
        'S' => vec![bow(&[], s_bow(), &[])],
        'T' => vec![line(&[(0.0, 1.0), (w, 1.0)]), line(&[(w / 2.0, 1.0), (w / 2.0, 0.0)])],
        'U' => vec![bow(&[(0.0, 1.0)], arc(w / 2.0, w / 2.0, w / 2.0, w / 2.0, 180.0, 360.0), &[(w, 1.0)])],
        'Y' => vec![line(&[(0.0, 1.0), (w / 2.0, 0.5), (w, 1.0)]), line(&[(w / 2.0, 0.5), (w / 2.0, 0.0)])],
        '1' => vec![
            line(&[(w * 0.15, 0.78), (w / 2.0, 1.0), (w / 2.0, 0.0)]),
            line(&[(w * 0.1, 0.0), (w * 0.9, 0.0)]),
        ],
        '2' => vec![bow(&[], arc(w / 2.0, 0.72, w / 2.0, 0.28, 170.0, -40.0), &[(0.0, 0.0), (w, 0.0)])],
        '3' => vec![
            arc(w / 2.0, 0.75, w * 0.45, 0.25, 150.0, -90.0),
            arc(w / 2.0, 0.25, w / 2.0, 0.25, 90.0, -150.0),
        ],
        '4' => vec![line(&[(w * 0.8, 0.0), (w * 0.8, 1.0), (0.0, 0.33), (w, 0.33)])],
        '5' => vec![bow(
            &[(w * 0.9, 1.0), (w * 0.1, 1.0)],
            arc(w / 2.0, 0.31, w / 2.0, 0.31, 135.0, -140.0),
            &[],
        )],
        _ => Vec::new(),
    }
}

/// The letter S: two arcs, one turning left and one right.
fn s_bow() -> Stroke {
    let upper = arc(WIDTH / 2.0, 0.75, WIDTH * 0.48, 0.25, 30.0, 270.0);
    let lower = arc(WIDTH / 2.0, 0.25, WIDTH * 0.5, 0.25, 90.0, -150.0);
    upper.into_iter().chain(lower.into_iter().skip(1)).collect()
}

fn line(points: &[(f64, f64)]) -> Stroke {
    points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
}

fn bow(before: &[(f64, f64)], arc: Stroke, after: &[(f64, f64)]) -> Stroke {
    line(before).into_iter().chain(arc).chain(line(after)).collect()
}

/// A part of an ellipse. Angles are in degrees, counter-clockwise from +x.
fn arc(x: f64, y: f64, radius_x: f64, radius_y: f64, from_deg: f64, to_deg: f64) -> Stroke {
    /// Number of straight segments of the arc.
    const PARTS: usize = 48;
    let at = |part: usize| {
        let direction =
            Vec2::unit((from_deg + (to_deg - from_deg) * part as f64 / PARTS as f64).to_radians());
        Vec2::new(x + direction.x * radius_x, y + direction.y * radius_y)
    };
    (0..=PARTS).map(at).collect()
}
