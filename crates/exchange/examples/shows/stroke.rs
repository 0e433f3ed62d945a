//! Evenly spaced places along lines.

use lightbots_base::Vec2;

/// A line through these points.
pub type Stroke = Vec<Vec2>;

/// `count` places on a circle, the first at `from_turns` of a turn counter-clockwise from +x.
pub fn ring(centre: Vec2, radius_m: f64, count: usize, from_turns: f64) -> Vec<Vec2> {
    let turn = std::f64::consts::TAU;
    (0..count)
        .map(|nth| centre + Vec2::unit(turn * (from_turns + nth as f64 / count as f64)) * radius_m)
        .collect()
}

/// `count` places `step_m` apart, centred on `middle`, along x.
pub fn row(middle: Vec2, step_m: f64, count: usize) -> Vec<Vec2> {
    let left = (count as f64 - 1.0) / 2.0;
    (0..count).map(|nth| middle + Vec2::new((nth as f64 - left) * step_m, 0.0)).collect()
}

/// `count` places along an open line, from its start to its end.
pub fn along(line: &[Vec2], count: usize) -> Vec<Vec2> {
    let length = length(line);
    (0..count).map(|nth| at_length(line, length * nth as f64 / (count.max(2) - 1) as f64)).collect()
}

/// `count` places along a line that ends where it starts.
pub fn around(line: &[Vec2], count: usize) -> Vec<Vec2> {
    let length = length(line);
    (0..count).map(|nth| at_length(line, length * nth as f64 / count as f64)).collect()
}

/// At most `count` places, as many as are found, spread evenly over all strokes. Each end and sharp corner has one, or
/// one nearby.
pub fn trace(strokes: &[Stroke], count: usize) -> Vec<Vec2> {
    let parts: Vec<Stroke> = strokes.iter().flat_map(|stroke| straightened(stroke)).collect();
    let total: f64 = parts.iter().map(|part| length(part)).sum();
    let mut best = Vec::new();
    for finer in 0..1_000 {
        let step_m = 2.0 * total / count as f64 * (1.0 - finer as f64 / 1_000.0);
        let places = spaced(&parts, step_m);
        let places_count = places.len();
        if places_count <= count && places_count > best.len() {
            best = places;
        }
        // Finer steps give more places, but not always just one more. Beyond this number a better result is unlikely.
        if best.len() == count || places_count > count * 3 / 2 {
            break;
        }
    }
    best
}

/// Places about `step_m` apart along the parts. A place closer than 0.7 steps to an earlier one is left out, so that
/// parts that meet share a place.
fn spaced(parts: &[Stroke], step_m: f64) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = Vec::new();
    for part in parts {
        let steps = (length(part) / step_m).round().max(1.0) as usize;
        for place in along(part, steps + 1) {
            if places.iter().all(|other| other.distance(place) > 0.7 * step_m) {
                places.push(place);
            }
        }
    }
    places
}

/// The parts of a line between its sharp corners.
fn straightened(line: &[Vec2]) -> Vec<Stroke> {
    let mut parts = Vec::new();
    let mut part = vec![line[0]];
    for (nth, &point) in line.iter().enumerate().skip(1) {
        part.push(point);
        let Some(&next) = line.get(nth + 1) else { break };
        let (into, out) = (point - line[nth - 1], next - point);
        let is_sharp = into.dot(out) < 0.8 * into.length() * out.length();
        if is_sharp {
            parts.push(std::mem::replace(&mut part, vec![point]));
        }
    }
    parts.push(part);
    parts
}

fn length(line: &[Vec2]) -> f64 {
    line.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn at_length(line: &[Vec2], mut along_m: f64) -> Vec2 {
    for pair in line.windows(2) {
        let length = pair[0].distance(pair[1]);
        if along_m <= length && length > 0.0 {
            return pair[0].lerp(pair[1], along_m / length);
        }
        along_m -= length;
    }
    line[line.len() - 1]
}
