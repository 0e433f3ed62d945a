//! Paths with delayed starts.

use crate::Path;
use lightbots_base::{Piece, Span};

/// Delays the start of each path by `delays[robot]`. All results last equally long: as long as the longest of `paths`,
/// or until the last delayed robot arrives, if that is later.
pub(crate) fn delayed(paths: &[Path], delays: &[Span]) -> Vec<Path> {
    let driving = paths.iter().zip(delays).filter(|(path, _)| !path.as_ref().rests());
    let latest = driving.map(|(path, delay)| ends(path) + *delay);
    let before = Path::longest(paths);
    let duration = latest.max().unwrap_or(Span::ZERO).max(before);
    let later = |(path, delay): (&Path, &Span)| {
        let mut later = Path { start: path.start, pieces: Vec::with_capacity(path.pieces.len() + 2) };
        add_rest(&mut later, *delay);
        path.pieces.iter().for_each(|piece| add(&mut later, *piece));
        let over = later.as_ref().duration() - duration;
        if over > Span::ZERO {
            shorten(&mut later, over);
        } else {
            add_rest(&mut later, Span(-over.0));
        }
        later
    };
    paths.iter().zip(delays).map(later).collect()
}

/// Moment after which a path rests until its end, counted from its start; 0 if it never moves.
pub(crate) fn ends(path: &Path) -> Span {
    let moving = path.as_ref().timed().filter(|(from, _, piece)| !piece.is_rest(*from));
    moving.map(|(_, begin, piece)| begin + piece.duration).last().unwrap_or(Span::ZERO)
}

fn add(path: &mut Path, piece: Piece) {
    let at = path.as_ref().end();
    if piece.is_rest(at) { add_rest(path, piece.duration) } else { path.pieces.push(piece) }
}

fn add_rest(path: &mut Path, duration: Span) {
    if duration <= Span::ZERO {
        return;
    }
    let at = path.as_ref().end();
    let before = path.pieces.len().checked_sub(2).map_or(path.start, |index| path.pieces[index].end);
    match path.pieces.last_mut() {
        Some(last) if last.is_rest(before) => last.duration += duration,
        _ => path.pieces.push(Piece::rest(at, duration)),
    }
}

/// Shortens the last piece of a path, which is a rest, by `by`.
fn shorten(path: &mut Path, by: Span) {
    if let Some(last) = path.pieces.last_mut() {
        last.duration -= by;
        if last.duration <= Span::ZERO {
            path.pieces.pop();
        }
    }
}
