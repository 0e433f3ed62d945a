//! Cuts letters at the left and right edge of a window.

use lightbots_base::Vec2;

use super::letter::Letter;
use super::strokes::StrokeLine;

/// Returns the part of a letter with x between `from` and `to`.
pub(super) fn clipped(letter: &Letter, from: f64, to: f64) -> Letter {
    let cut = |lines: &[StrokeLine], half: fn(&[StrokeLine]) -> Vec<StrokeLine>| {
        let beyond_left = half(&mapped(lines, |x| x - from));
        // After mirroring, the right edge is a left edge.
        let beyond_both = half(&mapped(&beyond_left, |x| to - (x + from)));
        mapped(&beyond_both, |x| to - x)
    };
    Letter {
        text: letter.text.clone(),
        at: letter.at,
        rings: cut(&letter.rings, half_rings),
        lines: cut(&letter.lines, half_lines),
        spine: cut(&letter.spine, half_lines),
    }
}

fn mapped(lines: &[StrokeLine], x: impl Fn(f64) -> f64) -> Vec<StrokeLine> {
    lines.iter().map(|line| line.iter().map(|point| Vec2::new(x(point.x), point.y)).collect()).collect()
}

/// Returns the point with x = 0 on the line from `a` to `b`.
fn crossing(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(0.0, a.lerp(b, a.x / (a.x - b.x)).y)
}

/// Returns the parts of lines with x of at least 0.
fn half_lines(lines: &[StrokeLine]) -> Vec<StrokeLine> {
    let mut kept: Vec<StrokeLine> = Vec::new();
    for line in lines {
        kept.append(&mut pieces(line));
    }
    kept.retain(|line| line.len() >= 2);
    kept
}

/// Returns the pieces of one line with x of at least 0, from the start of the line on.
fn pieces(line: &[Vec2]) -> Vec<StrokeLine> {
    let mut pieces: Vec<StrokeLine> = Vec::new();
    let mut open: StrokeLine = line.first().filter(|point| point.x >= 0.0).copied().into_iter().collect();
    for pair in line.windows(2) {
        let [a, b] = pair else { continue };
        match (a.x >= 0.0, b.x >= 0.0) {
            (true, true) => open.push(*b),
            (true, false) => {
                open.push(crossing(*a, *b));
                pieces.push(std::mem::take(&mut open));
            }
            (false, true) => open = vec![crossing(*a, *b), *b],
            (false, false) => {}
        }
    }
    pieces.push(open);
    pieces
}

/// Returns the parts of rings with x of at least 0. Along the cut, the pieces of all rings are joined as one area, so
/// that gaps between strokes stay open.
fn half_rings(rings: &[Vec<Vec2>]) -> Vec<Vec<Vec2>> {
    let mut whole = Vec::new();
    let mut open: Vec<StrokeLine> = Vec::new();
    for ring in rings {
        match ring.iter().position(|point| point.x < 0.0) {
            None => whole.push(ring.clone()),
            Some(outside) => {
                // The ring as a line that begins and ends outside: none of its pieces is split.
                let line: StrokeLine =
                    ring.iter().cycle().skip(outside).take(ring.len() + 1).copied().collect();
                open.extend(pieces(&line).into_iter().filter(|piece| piece.len() >= 2));
            }
        }
    }
    whole.append(&mut joined(&open));
    whole.retain(|ring| ring.len() >= 3);
    whole
}

/// An end of a piece of a ring on the cut x = 0. `leaves`: the ring leaves the kept half here.
#[derive(Clone, Copy)]
struct End {
    y: f64,
    piece: usize,
    leaves: bool,
}

/// Joins pieces that begin and end on the cut to rings. Along the cut, each end where a ring leaves is joined with an
/// end where a ring enters, like opening and closing brackets.
fn joined(pieces: &[StrokeLine]) -> Vec<Vec<Vec2>> {
    let mut ends: Vec<End> = Vec::new();
    for (piece, line) in pieces.iter().enumerate() {
        if let (Some(first), Some(last)) = (line.first(), line.last()) {
            ends.push(End { y: first.y, piece, leaves: false });
            ends.push(End { y: last.y, piece, leaves: true });
        }
    }
    ends.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.piece.cmp(&b.piece)));
    let mut next: Vec<Option<usize>> = vec![None; pieces.len()];
    let mut stack: Vec<End> = Vec::new();
    for end in ends {
        match stack.last().copied() {
            Some(top) if top.leaves != end.leaves => {
                stack.pop();
                let (leaves, enters) = if end.leaves { (end, top) } else { (top, end) };
                next[leaves.piece] = Some(enters.piece);
            }
            _ => stack.push(end),
        }
    }
    rings(pieces, next)
}

fn rings(pieces: &[StrokeLine], mut next: Vec<Option<usize>>) -> Vec<Vec<Vec2>> {
    let mut rings = Vec::new();
    for start in 0..pieces.len() {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(following) = next[at].take() {
            ring.extend_from_slice(&pieces[at]);
            at = following;
        }
        rings.push(ring);
    }
    rings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Vec2> {
        points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    fn letter(rings: Vec<Vec<Vec2>>) -> Letter {
        Letter { rings, ..Letter::default() }
    }

    fn area(rings: &[Vec<Vec2>]) -> f64 {
        let of = |ring: &Vec<Vec2>| {
            (0..ring.len()).map(|at| ring[at].cross(ring[(at + 1) % ring.len()])).sum::<f64>() / 2.0
        };
        rings.iter().map(of).sum()
    }

    #[test]
    fn the_arms_of_an_e_become_rings_of_their_own() {
        let e = ring(&[(0., 0.), (3., 0.), (3., 1.), (1., 1.), (1., 2.), (3., 2.), (3., 3.), (0., 3.)]);
        let cut = clipped(&letter(vec![e.clone()]), 2.0, 9.0);
        assert_eq!(cut.rings.len(), 2);
        assert!((area(&cut.rings) - 2.0).abs() < 1e-12);
        let rest = clipped(&letter(vec![e]), -1.0, 2.0);
        assert_eq!(rest.rings.len(), 1);
        assert!((area(&rest.rings) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn a_hole_at_the_edge_opens() {
        let outer = ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]);
        let hole = ring(&[(1., 1.), (1., 3.), (3., 3.), (3., 1.)]);
        let cut = clipped(&letter(vec![outer, hole]), -1.0, 2.0);
        assert_eq!(cut.rings.len(), 1);
        assert!((area(&cut.rings) - 6.0).abs() < 1e-12);
    }

    #[test]
    fn a_line_through_the_window_is_cut_at_both_ends() {
        let line = vec![ring(&[(-5., 0.), (5., 0.), (5., 1.), (-5., 1.)])];
        let cut = clipped(&Letter { lines: line, ..Letter::default() }, 0.0, 2.0);
        assert_eq!(cut.lines, [ring(&[(0., 0.), (2., 0.)]), ring(&[(2., 1.), (0., 1.)])]);
    }
}
