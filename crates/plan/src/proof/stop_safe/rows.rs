//! Places of all robots at consecutive moments.

use crate::Path;
use crate::proof::grid::Bounds;
use lightbots_base::{Span, Vec2};
use std::collections::VecDeque;

/// Time between two sampled moments.
pub(crate) const STEP: Span = Span::from_millis(50);

/// The places of all robots at a moment and at some after it, which go back in time together.
pub(super) struct Rows<'a> {
    cursors: Vec<Cursor<'a>>,
    /// `rows[steps ahead][robot]`, stage metres.
    rows: VecDeque<Vec<Vec2>>,
    first: Span,
}

/// How far back a path has been read.
struct Cursor<'a> {
    path: &'a Path,
    /// The piece it is in, and when that begins.
    piece: usize,
    begin: Span,
}

impl<'a> Rows<'a> {
    /// Places at a moment at which all paths have ended, or end within a step, and at `ahead` steps after it.
    pub fn new(paths: &'a [Path], ahead: usize, first: Span) -> Self {
        let cursor =
            |path: &'a Path| Cursor { path, piece: path.pieces.len(), begin: path.as_ref().duration() };
        let mut cursors: Vec<_> = paths.iter().map(cursor).collect();
        let mut rows = VecDeque::new();
        for step in (0..=ahead).rev() {
            let at = first + STEP * step as i64;
            rows.push_front(cursors.iter_mut().map(|cursor| cursor.at(at)).collect());
        }
        Self { cursors, rows, first }
    }

    /// The first row's moment.
    pub fn first(&self) -> Span {
        self.first
    }

    /// Place of a robot `ahead` steps after the first moment, stage metres.
    pub fn at(&self, ahead: usize, robot: usize) -> Vec2 {
        self.rows[ahead][robot]
    }

    /// A box around all places of a robot.
    pub fn bounds(&self, robot: usize) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        self.rows.iter().for_each(|row| bounds.include(row[robot]));
        bounds
    }

    /// Goes back by `by` steps.
    pub fn go_back(&mut self, by: usize) {
        let read = self.rows.len();
        self.first -= STEP * by as i64;
        for step in (0..by.min(read)).rev() {
            let at = self.first + STEP * step as i64;
            let mut row = self.rows.pop_back().unwrap_or_default();
            row.clear();
            row.extend(self.cursors.iter_mut().map(|cursor| cursor.at(at)));
            self.rows.push_front(row);
        }
    }
}

impl Cursor<'_> {
    /// Where the path is at a moment no later than the one before.
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
