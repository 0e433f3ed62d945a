//! Finds places for the robots of one part of a drawing, in one style.

use lightbots_base::Vec2;

use crate::apart::{Freedom, Room, push_apart, push_parts_apart};
use crate::buckets::{Buckets, closest_distance};
use crate::coverage::Sample;
use crate::geometry::{bounds, hexagonal_count};
use crate::ground::{Ground, Quality};
use crate::lines::LineSet;
use crate::occupy::{LinePlace, occupy};
use crate::relax::{Lloyd, energy};
use crate::seeds::seeds;
use crate::symmetry::{Mirror, Pairing, symmetric_share};

/// How robots show areas. A part that lacks what a style needs is filled, or gets robots along its strokes if it has no
/// areas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// [`Style::Both`], [`Style::Lines`] or [`Style::Filled`], the same for all parts. The choice depends on the size
    /// of the parts and the number of robots.
    #[default]
    Auto,
    /// Robots fill areas evenly.
    Filled,
    /// Robots stand along the edges of areas.
    Outline,
    /// Robots stand along the edges of areas and fill their inside evenly.
    Both,
    /// Robots stand along strokes. Areas are replaced by their spine, such as the middle lines of a letter.
    Lines,
}

/// Places are pushed apart until the closest pair has this distance, as a share of the ideal spacing. With a larger
/// share, places would have too little room to move.
const APART: f64 = 0.88;

/// A symmetric arrangement is chosen if its energy is at most this multiple of the asymmetric arrangement's energy.
const SYMMETRY_WORTH: f64 = 1.25;

/// Mean squared distance of the points of a hexagon of area 1 from its middle: 5 / (18 √3). No other shape of equal
/// cells that fill a plane has less.
const HEXAGON: f64 = 0.160_375;

/// An arrangement is even enough if its energy is at most this multiple of the energy of hexagons. The edges of a
/// drawing alone cause about this much energy.
const EVEN: f64 = 1.2;

/// Least distance between places on an outline, in spacings. Near a tip, a place closer than this to another one moves
/// from the outline into the area.
const EDGE_APART: f64 = 0.82;

/// Least distance between places along lines, in spacings. Beside the tip of a five-pointed star, places are 0.66
/// spacings apart at first, and are pushed apart later.
const LINE_APART: f64 = 0.6;

/// Up to this number of places in a part, several numbers of places on the mirror axis are tried. An asymmetric
/// arrangement is then tried as well.
const FEW: usize = 60;

/// The places of one part, and how each place may move.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    pub places: Vec<Vec2>,
    pub holds: Vec<Freedom>,
    /// `true`: places that slide do so along the outline. `false`: along the lines.
    pub is_on_outline: bool,
}

/// The task to find places for one part.
pub(crate) struct LayoutTask<'a> {
    pub ground: &'a Ground,
    /// Places that stay where they are. They come first in every list of places.
    pub kept: &'a [Vec2],
    /// Number of all places, including the kept places.
    pub count: usize,
    /// Places to begin with, the kept places first, such as the places of the previous picture. Used only for filling
    /// areas, and only if their number is the number of places wanted there.
    pub start: &'a [Vec2],
    pub quality: Quality,
    pub seed: u64,
}

impl LayoutTask<'_> {
    /// Returns places in a style: exactly `count` places, unless the part is empty.
    pub fn layout(&self, style: Style) -> Layout {
        let ground = self.ground;
        let (has_areas, has_lines) = (!ground.samples.is_empty(), !ground.lines.lines.is_empty());
        let has_outline = !ground.outline.lines.is_empty();
        match style {
            Style::Lines if has_lines => self.along(&ground.lines),
            Style::Outline if has_outline => Layout { is_on_outline: true, ..self.along(&ground.outline) },
            Style::Both if has_outline => self.both(),
            _ if has_areas => self.filled(),
            _ => self.along(&ground.lines),
        }
    }

    fn along(&self, track: &LineSet) -> Layout {
        let free = self.count.saturating_sub(self.kept.len());
        let spacing = track.length() / self.count.max(1) as f64;
        let mut layout = Layout::from_kept(self.kept);
        for (at, hold) in self.spread(track, free, spacing) {
            layout.places.push(at);
            layout.holds.push(hold);
        }
        self.part(&mut layout, APART * spacing, track, None);
        layout
    }

    /// Returns `count` places along lines. No two of them are much closer than the spacing, if this is possible. Where
    /// lines meet at a small angle, some places are left out, and others are added elsewhere.
    fn spread(&self, track: &LineSet, count: usize, spacing: f64) -> Vec<LinePlace> {
        let all = |count: usize| occupy(track, count, self.ground.size, self.ground.mirror);
        for more in 0..=count / 4 {
            let places = sparse(all(count + more), LINE_APART * spacing);
            if places.len() == count {
                return places;
            }
            if places.len() > count {
                break;
            }
        }
        all(count)
    }

    /// Places robots on the outline and inside, with about equal spacing on both.
    fn both(&self) -> Layout {
        let ground = self.ground;
        let spacing = balanced_spacing(ground.outline.length(), ground.mass, self.count);
        let mut layout = Layout::from_kept(self.kept);
        layout.is_on_outline = true;
        for (at, hold) in self.edge(spacing) {
            layout.places.push(at);
            layout.holds.push(hold);
        }
        let inner = self.count.saturating_sub(layout.places.len());
        let (places, pairing) = self.relaxed(&layout.places, inner, spacing);
        layout.holds.extend(vec![Freedom::Free; places.len() - layout.places.len()]);
        layout.places = places;
        self.part(&mut layout, APART * spacing, &ground.outline, pairing.as_ref());
        layout
    }

    /// Returns places on the outline: about as many as fit at this spacing. The number is changed by up to two if the
    /// places are then more symmetric.
    fn edge(&self, spacing: f64) -> Vec<LinePlace> {
        let ground = self.ground;
        let usual = (ground.outline.length() / spacing).round() as usize;
        let free = self.count.saturating_sub(self.kept.len());
        let sparse = |count: usize| {
            let places = occupy(&ground.outline, count.min(free), ground.size, ground.mirror);
            sparse(places, EDGE_APART * spacing)
        };
        let Some(mirror) = ground.mirror else { return sparse(usual) };
        let symmetry = |places: &Vec<LinePlace>| {
            let places: Vec<Vec2> = places.iter().map(|(at, _)| *at).collect();
            symmetric_share(mirror, &places, 0.1 * spacing)
        };
        let counts = [usual, usual + 1, usual.saturating_sub(1), usual + 2, usual.saturating_sub(2)];
        let mut best = sparse(usual);
        for places in counts.into_iter().skip(1).map(sparse) {
            if symmetry(&best) > 0.99 {
                break;
            }
            if symmetry(&places) > symmetry(&best) {
                best = places;
            }
        }
        best
    }

    fn filled(&self) -> Layout {
        let spacing = self.ground.spacing(self.count);
        let (places, pairing) = self.relaxed(self.kept, self.count.saturating_sub(self.kept.len()), spacing);
        let mut layout = Layout::from_kept(self.kept);
        layout.holds.extend(vec![Freedom::Free; places.len() - layout.places.len()]);
        layout.places = places;
        self.part(&mut layout, APART * spacing, &self.ground.lines, pairing.as_ref());
        layout
    }

    fn part(&self, layout: &mut Layout, distance: f64, track: &LineSet, pairing: Option<&Pairing>) {
        let (inside, on_track) = (self.ground.buckets(), track.buckets());
        let room = Room { pairing, ..self.ground.room(&inside, track, &on_track) };
        push_apart(&mut layout.places, &layout.holds, distance, &room);
    }

    /// Returns the places in `fixed`, then `count` relaxed places in the areas, and the pairing of symmetric places. If
    /// `start` has the right number of places, relaxation begins with them, and symmetry is not sought. Otherwise, if
    /// the areas are symmetric and no place is kept, the places are symmetric, with one exception. Asymmetric places
    /// are returned if the energy of symmetric places is more than [`SYMMETRY_WORTH`] times theirs.
    fn relaxed(&self, fixed: &[Vec2], count: usize, spacing: f64) -> (Vec<Vec2>, Option<Pairing>) {
        if count == 0 || self.ground.samples.is_empty() {
            return (fixed.to_vec(), None);
        }
        if self.start.len() == fixed.len() + count {
            let mut places = self.aligned_start();
            self.relaxation(fixed.len(), spacing, None).run(&mut places);
            return (places, None);
        }
        let value = |places: &[Vec2]| energy(&self.ground.samples, places, spacing);
        let free = || self.asymmetric(fixed, count, spacing);
        let Some(mirror) = self.ground.mirror.filter(|_| self.kept.is_empty()) else { return (free(), None) };
        let symmetric = singles(&self.ground.samples, mirror, count, spacing)
            .into_iter()
            .map(|single| self.symmetric(fixed, count, single, mirror, spacing))
            .min_by(|a, b| value(&a.0).total_cmp(&value(&b.0)));
        let Some((places, pairing)) = symmetric else { return (free(), None) };
        let all = fixed.len() + count;
        if all > FEW && value(&places) <= EVEN * HEXAGON * self.ground.mass / all as f64 {
            return (places, Some(pairing));
        }
        let free = free();
        if value(&places) <= SYMMETRY_WORTH * value(&free) { (places, Some(pairing)) } else { (free, None) }
    }

    /// Returns the places of `start`, all shifted by the same vector: the middle of their box is then the middle of the
    /// box of the samples. The drawing may have moved since those places were made.
    fn aligned_start(&self) -> Vec<Vec2> {
        let middle = |points: &[Vec2]| bounds(points).map_or(Vec2::ZERO, |(low, high)| low.lerp(high, 0.5));
        let shift = middle(&self.ground.inside) - middle(self.start);
        self.start.iter().map(|at| *at + shift).collect()
    }

    fn relaxation<'b>(&'b self, kept: usize, spacing: f64, pairing: Option<&'b Pairing>) -> Lloyd<'b> {
        Lloyd { samples: &self.ground.samples, kept, spacing, rounds: self.quality.rounds(), pairing }
    }

    fn asymmetric(&self, fixed: &[Vec2], count: usize, spacing: f64) -> Vec<Vec2> {
        let mut places = fixed.to_vec();
        places.extend(seeds(&self.ground.samples, fixed, count, spacing, self.seed));
        self.relaxation(fixed.len(), spacing, None).run(&mut places);
        places
    }

    /// Finds symmetric places, after those in `fixed`: `single` of the `count` new places are on the axis `mirror`, the
    /// others are pairs of mirror images.
    fn symmetric(
        &self,
        fixed: &[Vec2],
        count: usize,
        single: usize,
        mirror: Mirror,
        spacing: f64,
    ) -> (Vec<Vec2>, Pairing) {
        let margin = if single > 0 { 0.3 * spacing } else { 0.0 };
        let right = |at: Vec2| mirror.side(at) > margin;
        let side: Vec<Sample> =
            self.ground.samples.iter().filter(|sample| right(sample.at)).copied().collect();
        let kept: Vec<Vec2> = fixed.iter().filter(|at| right(**at)).copied().collect();
        let halves = seeds(&side, &kept, (count - single) / 2, spacing, self.seed);
        let axis = on_axis(&self.ground.samples, mirror, single, self.ground.pitch);
        let (free, pairing) = Pairing::unfold(mirror, &halves, &axis);
        let pairing = pairing.after(fixed.len());
        let mut places = fixed.to_vec();
        places.extend(free);
        self.relaxation(fixed.len(), spacing, Some(&pairing)).run(&mut places);
        (places, pairing)
    }
}

/// Pushes places of different parts apart, until no pair is closer than the closest pair within any part. The number of
/// rounds is limited. Places of different parts are too close where a line leads behind an area.
pub(crate) fn separate(grounds: &[&Ground], layouts: &mut [Layout]) {
    let distance =
        layouts.iter().map(|layout| closest_distance(&layout.places)).fold(f64::INFINITY, f64::min);
    if layouts.len() < 2 || !distance.is_finite() {
        return;
    }
    let tracks: Vec<&LineSet> = grounds
        .iter()
        .zip(layouts.iter())
        .map(|(ground, layout)| if layout.is_on_outline { &ground.outline } else { &ground.lines })
        .collect();
    let inside: Vec<Buckets<'_>> = grounds.iter().map(|ground| ground.buckets()).collect();
    let on_tracks: Vec<Buckets<'_>> = tracks.iter().map(|track| track.buckets()).collect();
    let rooms: Vec<Room<'_>> = (0..grounds.len())
        .map(|part| grounds[part].room(&inside[part], tracks[part], &on_tracks[part]))
        .collect();
    let owners: Vec<usize> =
        layouts.iter().enumerate().flat_map(|(part, layout)| vec![part; layout.places.len()]).collect();
    let holds: Vec<Freedom> = layouts.iter().flat_map(|layout| layout.holds.clone()).collect();
    let mut places: Vec<Vec2> = layouts.iter().flat_map(|layout| layout.places.clone()).collect();
    push_parts_apart(&mut places, &holds, distance, &rooms, &owners);
    let mut moved = places.into_iter();
    for layout in layouts {
        layout.places.iter_mut().zip(&mut moved).for_each(|(place, now)| *place = now);
    }
}

/// Of two places closer than `distance`, drops one that may slide. Places are this close on both sides of a sharp tip.
fn sparse(places: Vec<LinePlace>, distance: f64) -> Vec<LinePlace> {
    let at: Vec<Vec2> = places.iter().map(|(at, _)| *at).collect();
    let mut stays = vec![true; places.len()];
    Buckets::new(&at, distance).pairs(distance, |a, b, _| {
        if stays[a] && stays[b] {
            let gone = if places[b].1 == Freedom::Line { b } else { a };
            stays[gone] = places[gone].1 == Freedom::Fixed;
        }
    });
    places.into_iter().zip(stays).filter(|(_, stays)| *stays).map(|(place, _)| place).collect()
}

/// Numbers of places on the axis that are worth a try. They match the density of the drawing there, and are even if
/// `count` is even, odd if it is odd.
fn singles(samples: &[Sample], mirror: Mirror, count: usize, spacing: f64) -> Vec<usize> {
    let near: f64 =
        samples.iter().filter(|s| mirror.side(s.at).abs() < spacing / 2.0).map(|s| s.mass).sum::<f64>();
    let usual = (near / (spacing * spacing * 0.866)).round() as usize;
    let reach = if count <= FEW { 3 } else { 1 };
    let range = usual.saturating_sub(reach)..=(usual + reach).min(count);
    let fitting = range.filter(|single| single % 2 == count % 2);
    let mut options: Vec<usize> = fitting.collect();
    if count > FEW {
        options.truncate(1);
    }
    options
}

/// Returns `count` places on the axis. They are distributed along it as the drawing is.
fn on_axis(samples: &[Sample], mirror: Mirror, count: usize, pitch: f64) -> Vec<Vec2> {
    let mut near: Vec<Vec2> =
        samples.iter().map(|s| s.at).filter(|at| mirror.side(*at).abs() < 1.5 * pitch).collect();
    if near.is_empty() {
        near = samples.iter().map(|sample| sample.at).collect();
    }
    near.sort_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y)));
    (0..count).map(|i| mirror.onto(near[(2 * i + 1) * near.len() / (2 * count)])).collect()
}

/// Returns the spacing s at which an outline of length L and a filling of area A together take N = `count` places. It
/// is the solution of L / s + (A − L s / 2) / (0.866 s²) = N.
fn balanced_spacing(length: f64, area: f64, count: usize) -> f64 {
    let taken = |s: f64| length / s + hexagonal_count(area - length * s / 2.0, s);
    let (mut low, mut high) = (1e-6 * length, length);
    for _ in 0..80 {
        let middle = (low * high).sqrt();
        if taken(middle) > count as f64 { low = middle } else { high = middle }
    }
    high
}

impl Layout {
    fn from_kept(kept: &[Vec2]) -> Self {
        Self { places: kept.to_vec(), holds: vec![Freedom::Fixed; kept.len()], is_on_outline: false }
    }
}
