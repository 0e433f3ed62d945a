//! Separates the thing in a picture from its background.

use crate::picture::bitmap::{BitMask, Bitmap, Oklab, difference, neighbours, oklab};

/// Pixels with less opacity than this, 0 to 255, count as transparent and do not belong to the thing.
const OPAQUE: u8 = 128;
/// If more than this share of the pixels is transparent, opacity alone separates the thing from its background.
const TRANSPARENT: f32 = 0.005;
/// A pixel at the edge of the picture is background if its colour differs by less than this from the edge's median
/// colour, in Oklab.
const EDGE_ALIKE: f32 = 0.15;
/// Least and largest value of the threshold between background and thing, as a difference of colours in Oklab. Otsu's
/// threshold is limited to this range.
const THRESHOLDS: [f32; 2] = [0.06, 0.35];
/// Share of the variance that Otsu's threshold explains: first for values without two groups, then for two clear
/// groups. Measured on 25 pictures on 2026-11-24.
const SEPARABLE: [f32; 2] = [0.6, 0.9];
/// Number of bins of the histogram of colour differences from 0 to 1.
const BINS: usize = 200;

/// Least certainty of a separation, 0 to 1, for which the silhouette is shown. On 2026-11-24 photographs of whole
/// scenes reached 0.0 to 0.6, things before sky or paper 0.7 to 1.0. A brick wall was taken for a background, with
/// 0.75.
const CERTAIN: f32 = 0.65;
/// Least and largest share of the picture that the thing may cover if its silhouette is shown.
const COVERS: [f64; 2] = [0.005, 0.95];

/// The thing in a picture, and how certain its separation from the background is.
#[derive(Clone, Debug)]
pub struct Separation {
    /// The pixels of the thing.
    pub mask: BitMask,
    /// Certainty of the separation: 0 if no background was found, 1 if thing and background are clearly different.
    pub certainty: f32,
}

impl Separation {
    /// Whether the silhouette can be shown: the separation is certain enough, and the thing neither too small nor too
    /// large.
    pub fn is_clear(&self) -> bool {
        let covers = self.mask.count() as f64 / self.mask.inside.len().max(1) as f64;
        self.certainty >= CERTAIN && (COVERS[0]..=COVERS[1]).contains(&covers)
    }
}

/// Separates the thing in a picture from its background. If parts of the picture are transparent, the thing is the
/// rest. Otherwise the thing is what differs from the colours along the edge of the picture.
pub fn separate(bitmap: &Bitmap) -> Separation {
    let clear = bitmap.pixels.iter().filter(|pixel| pixel[3] < OPAQUE).count();
    if clear as f32 > TRANSPARENT * bitmap.pixels.len() as f32 {
        let inside = bitmap.pixels.iter().map(|pixel| pixel[3] >= OPAQUE).collect();
        return Separation { mask: BitMask { columns: bitmap.columns, inside }, certainty: 1.0 };
    }
    let lab = oklab(bitmap.colors());
    let (background, share) = Background::of(bitmap, &lab);
    let away: Vec<f32> = (0..lab.len()).map(|index| difference(lab[index], background.at(index))).collect();
    let (best, separable) = otsu(&away);
    let threshold = best.clamp(THRESHOLDS[0], THRESHOLDS[1]);
    let apart = ((separable - SEPARABLE[0]) / (SEPARABLE[1] - SEPARABLE[0])).clamp(0.0, 1.0);
    // Below the least threshold the picture has hardly any contrast.
    let contrast = (best / threshold).min(1.0);
    let inside = not_flooded(bitmap, &away, threshold);
    let mask = BitMask { columns: bitmap.columns, inside };
    let empty = mask.count() == 0 || mask.count() == mask.inside.len();
    Separation { mask, certainty: if empty { 0.0 } else { share * apart * contrast } }
}

/// Colours of the background at every pixel, estimated from the edge of the picture.
struct Background {
    columns: usize,
    rows: usize,
    /// Colours along the top edge, by column.
    top: Vec<Oklab>,
    /// Colours along the bottom edge, by column.
    bottom: Vec<Oklab>,
    /// Colours along the left edge, by row from the top.
    left: Vec<Oklab>,
    /// Colours along the right edge, by row from the top.
    right: Vec<Oklab>,
}

impl Background {
    /// Estimates the background. Also returns the share of the picture's edge whose colour is like the edge's median
    /// colour.
    fn of(bitmap: &Bitmap, lab: &[Oklab]) -> (Self, f32) {
        let (columns, rows) = (bitmap.columns, bitmap.rows);
        let edge: Vec<Oklab> = bitmap.edge().filter_map(|index| lab.get(index).copied()).collect();
        let middle = middle(&edge);
        let alike = edge.iter().filter(|color| difference(**color, middle) < EDGE_ALIKE).count();
        let share = alike as f32 / edge.len().max(1) as f32;
        let side = |indices: &mut dyn Iterator<Item = usize>| {
            let colors: Vec<Oklab> = indices.filter_map(|index| lab.get(index).copied()).collect();
            smooth(&colors, middle)
        };
        let background = Self {
            columns,
            rows,
            top: side(&mut (0..columns)),
            bottom: side(&mut ((rows.saturating_sub(1)) * columns..rows * columns)),
            left: side(&mut (0..rows).map(|row| row * columns)),
            right: side(&mut (0..rows).map(|row| row * columns + columns.saturating_sub(1))),
        };
        (background, share)
    }

    /// Returns the background's colour at a pixel: a mean of the colours at the four sides, in which nearer sides weigh
    /// more.
    fn at(&self, index: usize) -> Oklab {
        let (x, y) = (index % self.columns, index / self.columns);
        let weight = |distance: usize| 1.0 / (1.0 + distance as f32);
        let sides = [
            (self.top.get(x), weight(y)),
            (self.bottom.get(x), weight(self.rows - 1 - y)),
            (self.left.get(y), weight(x)),
            (self.right.get(y), weight(self.columns - 1 - x)),
        ];
        let mut sum = [0.0; 3];
        let mut total = 0.0;
        for (color, weight) in sides {
            let color = color.copied().unwrap_or([0.0; 3]);
            sum.iter_mut().zip(color).for_each(|(sum, channel)| *sum += channel * weight);
            total += weight;
        }
        sum.map(|channel| channel / total)
    }
}

/// Returns the median of each channel.
fn middle(colors: &[Oklab]) -> Oklab {
    [0, 1, 2].map(|n| {
        let mut values: Vec<f32> = colors.iter().map(|color| color[n]).collect();
        values.sort_by(f32::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    })
}

/// Smooths the colours along a side over a sixteenth of its length. Colours unlike `middle` occur where the thing
/// reaches the edge; they are replaced by `middle`.
fn smooth(colors: &[Oklab], middle: Oklab) -> Vec<Oklab> {
    let alike = |color: &Oklab| if difference(*color, middle) < EDGE_ALIKE { *color } else { middle };
    let colors: Vec<Oklab> = colors.iter().map(alike).collect();
    let reach = colors.len() / 32 + 1;
    let mean = |at: usize| {
        let near = colors.get(at.saturating_sub(reach)..(at + reach + 1).min(colors.len())).unwrap_or(&[]);
        [0, 1, 2].map(|n| near.iter().map(|color| color[n]).sum::<f32>() / near.len().max(1) as f32)
    };
    (0..colors.len()).map(mean).collect()
}

/// Returns the threshold that separates small from large values with the largest variance between both groups (Otsu
/// 1979). Also returns the share of this variance in the total variance. Values are from 0 to 1.
fn otsu(values: &[f32]) -> (f32, f32) {
    let mut bins = [0.0f64; BINS];
    for value in values {
        let bin = ((value * BINS as f32) as usize).min(BINS - 1);
        bins[bin] += 1.0;
    }
    let count: f64 = bins.iter().sum();
    let moment = |power: i32| {
        bins.iter()
            .enumerate()
            .map(|(n, bin)| bin * if power == 1 { n as f64 } else { (n * n) as f64 })
            .sum::<f64>()
    };
    let (first, second) = (moment(1), moment(2));
    let variance = second / count - (first / count) * (first / count);
    let (mut below, mut sum, mut best) = (0.0, 0.0, (0.0, 0, 0));
    for (n, bin) in bins.iter().enumerate() {
        below += bin;
        sum += bin * n as f64;
        let above = count - below;
        if below > 0.0 && above > 0.0 {
            let apart = sum / below - (first - sum) / above;
            let between = below * above * apart * apart / (count * count);
            // Empty bins between both groups are equally good; the threshold is in their middle.
            best = match between.total_cmp(&best.0) {
                std::cmp::Ordering::Greater => (between, n + 1, n + 1),
                std::cmp::Ordering::Equal => (between, best.1, n + 1),
                std::cmp::Ordering::Less => best,
            };
        }
    }
    let separable = if variance > 0.0 { best.0 / variance } else { 0.0 };
    ((best.1 + best.2) as f32 / (2 * BINS) as f32, separable as f32)
}

/// Returns the pixels of the thing. `away`: each pixel's difference from the background. A flood through pixels below
/// `threshold`, from the picture's edge inwards, finds the background. Enclosed pixels with the background's colour are
/// holes.
fn not_flooded(bitmap: &Bitmap, away: &[f32], threshold: f32) -> Vec<bool> {
    let mut inside = vec![true; away.len()];
    let mut queue: Vec<usize> = bitmap.edge().filter(|index| away[*index] < threshold).collect();
    queue.iter().for_each(|index| inside[*index] = false);
    while let Some(index) = queue.pop() {
        for next in neighbours(index, bitmap.columns, away.len()) {
            if inside[next] && away[next] < threshold {
                inside[next] = false;
                queue.push(next);
            }
        }
    }
    // A hole shows the background itself; pale parts of the thing differ a little from it.
    let hole = threshold * 0.5;
    inside.iter_mut().zip(away).for_each(|(inside, away)| *inside &= *away >= hole);
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc of radius 12 pixels with a hole of radius 4 in a picture of 48. The background grows lighter to the
    /// right.
    fn ring(alpha: bool) -> Bitmap {
        let pixel = |index: usize| {
            let (x, y) = (index % 48, index / 48);
            let away = ((x as f32 - 24.0).powi(2) + (y as f32 - 24.0).powi(2)).sqrt();
            let grey = 180 + x as u8;
            match (4.0..12.0).contains(&away) {
                true => [200, 30, 30, 255],
                false => [grey, grey, grey, if alpha { 0 } else { 255 }],
            }
        };
        Bitmap { columns: 48, rows: 48, pixels: (0..48 * 48).map(pixel).collect() }
    }

    #[test]
    fn a_thing_is_found_by_opacity_or_by_the_colours_of_the_edge() {
        let by_alpha = separate(&ring(true));
        let by_color = separate(&ring(false));
        assert_eq!(by_alpha.mask.count(), ring(true).pixels.iter().filter(|pixel| pixel[1] == 30).count());
        assert_eq!(by_alpha.mask, by_color.mask);
        assert!(by_color.certainty > 0.8, "{}", by_color.certainty);
    }

    #[test]
    fn noise_has_no_background() {
        let mut state = 1;
        let mut byte = || lightbots_base::random::split_mix(&mut state) as u8;
        let pixels = (0..40 * 40).map(|_| [byte(), byte(), byte(), 255]).collect();
        let certainty = separate(&Bitmap { columns: 40, rows: 40, pixels }).certainty;
        assert!(certainty < 0.35, "{certainty}");
        let plain = Bitmap { columns: 9, rows: 9, pixels: vec![[9, 9, 9, 255]; 81] };
        assert_eq!(separate(&plain).certainty, 0.0);
    }
}
