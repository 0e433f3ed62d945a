//! Places of all robots at consecutive moments.

use crate::Path;
use crate::proof::grid::Bounds;
use lightbots_base::{Span, Vec2};

/// Time between two sampled moments.
pub(crate) const STEP: Span = Span::from_millis(50);

/// The places of all robots at consecutive moments, [`STEP`] apart. This window of moments moves back in time, from the
/// end of the paths to their start.
pub(super) struct Rows<'a> {
    cursors: Vec<Cursor<'a>>,
    /// Number of moments in the window.
    count: usize,
    /// `[robot × 2 count + first_row + steps after the first moment]`, stage metres. Each robot has a ring buffer, in
    /// which every place is stored twice, `count` apart. The window of a robot is therefore always one slice.
    places: Vec<Vec2>,
    /// Index of the window's first moment in each ring buffer, below `count`.
    first_row: usize,
    /// First moment of the window, counted from the start of the paths.
    first: Span,
}

/// Position up to which a path has been read, backwards from its end.
struct Cursor<'a> {
    path: &'a Path,
    /// Index of the current piece; the number of pieces for a position at the end of the path.
    piece: usize,
    /// Moment at which the current piece begins, counted from the start of the path.
    begin: Span,
}

impl<'a> Rows<'a> {
    /// Makes a window of the moment `first` and the `ahead` moments after it. All paths must have ended by `first`, or
    /// end less than a step after it.
    pub fn new(paths: &'a [Path], ahead: usize, first: Span) -> Self {
        let cursor =
            |path: &'a Path| Cursor { path, piece: path.pieces.len(), begin: path.as_ref().duration() };
        let count = ahead + 1;
        let mut rows = Self {
            cursors: paths.iter().map(cursor).collect(),
            count,
            places: vec![Vec2::ZERO; paths.len() * 2 * count],
            first_row: 0,
            first: first + STEP * count as i64,
        };
        rows.go_back(count);
        rows
    }

    /// Returns the first moment of the window, counted from the start of the paths.
    pub fn first(&self) -> Span {
        self.first
    }

    /// Places of a robot at all moments of the window, the earliest first, stage metres.
    pub fn of(&self, robot: usize) -> &[Vec2] {
        let first = robot * 2 * self.count + self.first_row;
        &self.places[first..first + self.count]
    }

    /// A box around all places of a robot in the window.
    pub fn bounds(&self, robot: usize) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        self.of(robot).iter().for_each(|&place| bounds.include(place));
        bounds
    }

    /// Moves the window back in time by `by` steps, and reads the places that are new in it.
    pub fn go_back(&mut self, by: usize) {
        self.first -= STEP * by as i64;
        let read = by.min(self.count);
        self.first_row = (self.first_row + self.count - read) % self.count;
        for (robot, cursor) in self.cursors.iter_mut().enumerate() {
            let places = &mut self.places[robot * 2 * self.count..][..2 * self.count];
            for step in (0..read).rev() {
                let place = cursor.at(self.first + STEP * step as i64);
                let row = (self.first_row + step) % self.count;
                (places[row], places[row + self.count]) = (place, place);
            }
        }
    }
}

impl Cursor<'_> {
    /// Returns the place of the path at a moment, stage metres. The moment must not be later than that of the call
    /// before.
    fn at(&mut self, moment: Span) -> Vec2 {
        let pieces = &self.path.pieces;
        while moment < self.begin && self.piece > 0 {
            self.piece -= 1;
            self.begin -= pieces[self.piece].duration;
        }
        let start = self.piece.checked_sub(1).map_or(self.path.start, |before| pieces[before].end);
        let piece = pieces.get(self.piece).filter(|_| moment > self.begin);
        piece.map_or(start, |piece| piece.at(start, moment - self.begin).position)
    }
}
