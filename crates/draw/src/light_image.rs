//! Draws lights and drawings as blurred grey pictures that can be compared.

use lightbots_base::Vec2;

/// Side of a cell of the image, in sigmas of the blur. At this size the blur shows no visible steps.
const CELL: f64 = 0.6;

/// Distance from a light at which its Gaussian is cut off, in sigmas.
const REACH: f64 = 3.5;

/// A grey picture made of square cells.
#[derive(Clone, Debug)]
pub(crate) struct LightImage {
    min: Vec2,
    pitch: f64,
    columns: usize,
    values: Vec<f64>,
}

impl LightImage {
    /// Draws points of light, each with a strength, as Gaussians of standard deviation `sigma`. The image covers the
    /// box from `low` to `high`, with a margin around it.
    pub fn new(points: impl Iterator<Item = (Vec2, f64)>, low: Vec2, high: Vec2, sigma: f64) -> Self {
        let pitch = CELL * sigma;
        let margin = Vec2::new(REACH, REACH) * sigma;
        let (min, size) = (low - margin, high - low + margin * 2.0);
        let (columns, rows) = ((size.x / pitch) as usize + 2, (size.y / pitch) as usize + 2);
        let mut image = Self { min, pitch, columns, values: vec![0.0; columns * rows] };
        for (at, strength) in points {
            image.splat(at, strength);
        }
        image.blur(sigma);
        image
    }

    /// Distributes the strength of a point over the four cells around it, so that the centroid stays at the point.
    fn splat(&mut self, at: Vec2, strength: f64) {
        let cell = (at - self.min) * (1.0 / self.pitch);
        let (x, y) = (cell.x.floor(), cell.y.floor());
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let share = (1.0 - (cell.x - x - dx).abs()) * (1.0 - (cell.y - y - dy).abs());
            let (column, row) = (x + dx, y + dy);
            if column >= 0.0
                && row >= 0.0
                && (column as usize) < self.columns
                && let Some(value) = self.values.get_mut(row as usize * self.columns + column as usize)
            {
                *value += strength * share;
            }
        }
    }

    fn blur(&mut self, sigma: f64) {
        let cells = sigma / self.pitch;
        let reach = (REACH * cells).ceil() as i64;
        let kernel: Vec<f64> =
            (-reach..=reach).map(|i| libm::exp(-0.5 * (i as f64 / cells) * (i as f64 / cells))).collect();
        let rows = self.values.len() / self.columns;
        self.values = convolved(&self.values, self.columns, rows, 1, self.columns, &kernel);
        self.values = convolved(&self.values, rows, self.columns, self.columns, 1, &kernel);
    }

    /// Normalised cross-correlation with a picture of the same box, 0 to 1. It is 1 if both are equal up to a factor of
    /// brightness, and 0 if one of them is dark.
    pub fn correlation(&self, other: &Self) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scale = (dot(&self.values, &self.values) * dot(&other.values, &other.values)).sqrt();
        if scale > 0.0 { dot(&self.values, &other.values) / scale } else { 0.0 }
    }
}

/// Convolves all rows or all columns of an image with a kernel. Each of the `lines` has `length` values, whose indices
/// differ by `step`. The first values of successive lines differ by `stride`.
fn convolved(
    values: &[f64],
    length: usize,
    lines: usize,
    step: usize,
    stride: usize,
    kernel: &[f64],
) -> Vec<f64> {
    let mut result = vec![0.0; values.len()];
    let reach = kernel.len() / 2;
    for line in 0..lines {
        for index in 0..length {
            let from = index.saturating_sub(reach);
            let to = (index + reach).min(length - 1);
            let sum: f64 = (from..=to)
                .map(|other| values[line * stride + other * step] * kernel[other + reach - index])
                .sum();
            result[line * stride + index * step] = sum;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_correlates_with_itself_and_not_with_one_elsewhere() {
        let image = |x: f64| {
            LightImage::new([(Vec2::new(x, 0.5), 2.0)].into_iter(), Vec2::ZERO, Vec2::new(3.0, 1.0), 0.07)
        };
        assert!((image(0.2).correlation(&image(0.2)) - 1.0).abs() < 1e-12);
        assert!(image(0.2).correlation(&image(2.0)) < 1e-6);
        // Two Gaussians at a distance d overlap by exp(−d²/4σ²). Distribution over cells widens them by 3 %.
        let expected = libm::exp(-0.25);
        assert!((image(0.5).correlation(&image(0.57)) - expected).abs() < 0.02);
    }
}
