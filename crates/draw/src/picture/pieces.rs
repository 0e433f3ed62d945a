//! Drops small separate spots of a mask and fills its small holes.

use crate::picture::bitmap::{BitMask, neighbours};

/// Pieces and holes smaller than this share of the largest piece are removed or filled.
const SMALLEST: f64 = 0.004;
/// Pieces and holes with fewer pixels than this are removed or filled in any case. The largest piece stays.
const PIXELS_MIN: usize = 12;
/// Largest number of pieces that stay. If there are more, the smallest pieces are removed.
const PIECES_MAX: usize = 200;

/// Removes small pieces of a mask and fills small holes in it, but no holes at the edge of the picture. The largest
/// piece always stays. Returns the number of removed pieces.
pub fn tidy(mask: &mut BitMask) -> usize {
    let mut pieces = connected(mask, true);
    pieces.sort_by_key(|piece| std::cmp::Reverse(piece.len()));
    let largest = pieces.first().map_or(0, Vec::len);
    let least = PIXELS_MIN.max((largest as f64 * SMALLEST) as usize);
    let kept = pieces.iter().take(PIECES_MAX).take_while(|piece| piece.len() >= least).count();
    let removed = pieces.split_off(kept.max(1).min(pieces.len()));
    set(mask, removed.iter().flatten(), false);
    let mut holes = connected(mask, false);
    holes.retain(|hole| hole.len() < least && !hole.iter().any(|at| on_edge(mask, *at)));
    set(mask, holes.iter().flatten(), true);
    removed.len()
}

fn set<'a>(mask: &mut BitMask, pixels: impl Iterator<Item = &'a usize>, inside: bool) {
    for index in pixels {
        if let Some(pixel) = mask.inside.get_mut(*index) {
            *pixel = inside;
        }
    }
}

fn on_edge(mask: &BitMask, index: usize) -> bool {
    let (x, y) = (index % mask.columns, index / mask.columns);
    x == 0 || y == 0 || x + 1 == mask.columns || y + 1 == mask.rows()
}

/// Returns sets of pixels that are connected by common sides: sets of pixels inside the mask if `inside`, else of all
/// others.
fn connected(mask: &BitMask, inside: bool) -> Vec<Vec<usize>> {
    let mut seen = vec![false; mask.inside.len()];
    let mut pieces = Vec::new();
    for start in 0..mask.inside.len() {
        if seen[start] || mask.inside[start] != inside {
            continue;
        }
        seen[start] = true;
        let mut piece = vec![start];
        let mut next = 0;
        while let Some(index) = piece.get(next).copied() {
            next += 1;
            for neighbour in neighbours(index, mask.columns, mask.inside.len()) {
                if !seen[neighbour] && mask.inside[neighbour] == inside {
                    seen[neighbour] = true;
                    piece.push(neighbour);
                }
            }
        }
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spots_go_and_small_holes_are_filled() {
        let square =
            |x: usize, y: usize, from: usize, to: usize| (from..to).contains(&x) && (from..to).contains(&y);
        let inside = |index: usize| {
            let (x, y) = (index % 40, index / 40);
            let hole = square(x, y, 6, 8) || square(x, y, 15, 20);
            (square(x, y, 4, 30) && !hole) || square(x, y, 33, 35)
        };
        let mut mask = BitMask { columns: 40, inside: (0..1600).map(inside).collect() };
        assert_eq!(tidy(&mut mask), 1);
        assert_eq!(mask.count(), 26 * 26 - 25);
    }

    #[test]
    fn a_lonely_spot_stays() {
        let mut mask = BitMask {
            columns: 3,
            inside: vec![false, false, false, false, true, false, false, false, false],
        };
        assert_eq!((tidy(&mut mask), mask.count()), (0, 1));
    }
}
