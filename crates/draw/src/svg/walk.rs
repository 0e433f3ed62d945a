//! Paints the elements of an SVG on a page, one after the other.

use lightbots_base::Rgb;
use usvg::tiny_skia_path::{Path as Outline, Transform};
use usvg::{ClipPath, FillRule, Group, Mask, MaskType, Node, Path};

use crate::drawing::FillRule as Rule;
use crate::error::DrawError;
use crate::ink::Ink;
use crate::svg::canvas::Canvas;
use crate::svg::flatten::{FlatLine, Spot, polylines};
use crate::svg::paint::ink;
use crate::svg::region::{Region, bounds};
use crate::svg::scan::too_large;

/// Paths with larger coordinates, in units of the page, are left out. Such coordinates come from broken files.
const COORDINATE_MAX: f32 = 1e6;
/// Largest distance of chords from their curves, as a share of the picture's longer side. It is below a tenth of the
/// spacing of 10,000 robots.
const TOLERANCE: f64 = 1.0 / 2_000.0;
/// A stroke at least this wide becomes an area; share of the picture's longer side. Icons of 24 pixels have lines of 2
/// pixels, which stay lines.
const WIDE: f64 = 0.15;
/// A stroke at least this wide cuts areas of other colours away beside it; share of the picture's longer side.
const VISIBLE: f64 = 0.015;
/// Largest number of areas and lines in a picture: more than robots could show.
const PARTS_MAX: usize = 20_000;
/// Largest number of points of all areas and lines.
const POINTS_MAX: usize = 500_000;
/// A mask keeps what is below its parts of at least this brightness, 0 to 1.
const MASK_MIN: f64 = 0.5;

/// A walk through the elements of an SVG, which paints them.
pub struct Walk {
    /// The page with all that is painted.
    pub canvas: Canvas,
    /// Number of paths with coordinates beyond [`COORDINATE_MAX`].
    pub beyond: usize,
    /// Longer side of the picture, units of the page.
    size: f64,
    parts: usize,
    points: usize,
}

/// Settings for all elements of a group.
#[derive(Clone)]
struct Context {
    /// Maps the coordinates of the group to the page.
    transform: Transform,
    /// Only paint inside all of these areas is visible.
    clips: Vec<Region>,
    opacity: f64,
    /// While a mask or clip path is painted: how its brightness is measured. `None` otherwise.
    mask: Option<MaskType>,
}

impl Walk {
    /// Paints a group on an empty page. `page`: corners of the page with the smaller and the larger coordinates.
    /// `size`: longer side of the group's content, in units of the page.
    ///
    /// # Errors
    /// Too many areas, lines or points.
    pub fn paint(root: &Group, page: (Spot, Spot), size: f64) -> Result<Self, DrawError> {
        let edge = Region::rectangle(page.0, page.1);
        let canvas = Canvas::new(edge.area(), size * TOLERANCE);
        let mut walk = Self { canvas, beyond: 0, size, parts: 0, points: 0 };
        let context =
            Context { transform: Transform::identity(), clips: vec![edge], opacity: 1.0, mask: None };
        walk.group(root, &context)?;
        Ok(walk)
    }

    fn tolerance(&self) -> f64 {
        self.size * TOLERANCE
    }

    fn group(&mut self, group: &Group, outer: &Context) -> Result<(), DrawError> {
        let mut context = outer.clone();
        context.transform = outer.transform.pre_concat(group.transform());
        context.opacity *= f64::from(group.opacity().get());
        let mut limits = Vec::new();
        if let Some(clip) = group.clip_path() {
            limits.push(self.clip(clip, context.transform)?);
        }
        if let Some(mask) = group.mask() {
            limits.push(self.mask(mask, context.transform)?);
        }
        for limit in limits {
            match limit {
                Some(region) => context.clips.push(region),
                None => {
                    self.canvas.hidden += 1;
                    return Ok(());
                }
            }
        }
        self.children(group, &context)
    }

    fn children(&mut self, group: &Group, context: &Context) -> Result<(), DrawError> {
        for node in group.children() {
            match node {
                Node::Group(inner) => self.group(inner, context)?,
                Node::Path(path) if path.is_visible() => self.path(path, context)?,
                // The letters of a text already have their places in the coordinates of the group.
                Node::Text(text) => self.group(text.flattened(), context)?,
                Node::Path(_) | Node::Image(_) => {}
            }
        }
        Ok(())
    }

    fn path(&mut self, path: &Path, context: &Context) -> Result<(), DrawError> {
        let sides = path.bounding_box().transform(context.transform);
        let sides = sides.map(|around| [around.left(), around.top(), around.right(), around.bottom()]);
        if sides.is_none_or(|sides| sides.iter().any(|side| !side.is_finite() || side.abs() > COORDINATE_MAX))
        {
            self.beyond += 1;
            return Ok(());
        }
        self.parts += 1;
        if self.parts > PARTS_MAX {
            return Err(too_large(format!("it has more than {PARTS_MAX} areas and lines")));
        }
        let filled = path.fill().and_then(|fill| Some((fill, ink(fill.paint(), context.transform)?)));
        if let Some((fill, (ink, share))) = &filled {
            let opacity = context.opacity * share * f64::from(fill.opacity().get());
            let region = self.filled(path.data(), context, rule(fill.rule()))?;
            self.fill(region, ink.clone(), opacity, context);
        }
        let below = filled.map(|(_, (ink, _))| ink);
        match path.stroke().and_then(|stroke| Some((stroke, ink(stroke.paint(), context.transform)?))) {
            Some((stroke, (ink, share))) => {
                let opacity = context.opacity * share * f64::from(stroke.opacity().get());
                self.stroke(path, stroke, (ink, opacity), below.as_ref(), context)
            }
            None => Ok(()),
        }
    }

    /// Returns the area inside a path. `None` if it is too thin, or if its lines cross too often.
    fn filled(&mut self, data: &Outline, context: &Context, rule: Rule) -> Result<Option<Region>, DrawError> {
        let lines = self.flattened(data, context)?;
        let rings: Vec<Vec<Spot>> = lines.into_iter().map(|line| line.points).collect();
        let region = Region::new(&rings, rule, self.tolerance());
        // Points where its own lines cross count too.
        self.points += region.as_ref().map_or(0, Region::points);
        Ok(region)
    }

    fn flattened(&mut self, data: &Outline, context: &Context) -> Result<Vec<FlatLine>, DrawError> {
        let lines = polylines(data, context.transform, self.tolerance());
        self.points += lines.iter().map(|line| line.points.len()).sum::<usize>();
        if self.points > POINTS_MAX {
            return Err(too_large(format!("its lines have more than {POINTS_MAX} points")));
        }
        Ok(lines)
    }

    fn fill(&mut self, region: Option<Region>, ink: Ink, opacity: f64, context: &Context) {
        let thinnest = self.tolerance();
        let clipped = context.clips.iter().fold(region, |region, clip| {
            let region = region?;
            let (low, high) = region.bounds();
            if clip.frames(low, high) || !self.canvas.affords(region.points() + clip.points()) {
                return Some(region);
            }
            region.common(clip, thinnest)
        });
        let (ink, opacity) = match context.mask {
            Some(kind) => (brightness(ink.color, opacity, kind).into(), 1.0),
            None => (ink, opacity),
        };
        match clipped {
            Some(region) => self.canvas.fill(region, ink, opacity),
            None => self.canvas.hidden += 1,
        }
    }

    fn stroke(
        &mut self,
        path: &Path,
        stroke: &usvg::Stroke,
        (ink, opacity): (Ink, f64),
        below: Option<&Ink>,
        context: &Context,
    ) -> Result<(), DrawError> {
        let Transform { sx, kx, ky, sy, .. } = context.transform;
        let scale = libm::sqrt(f64::from(sx * sy - kx * ky).abs());
        let width = f64::from(stroke.width().get()) * scale / self.size;
        let outline = if width >= VISIBLE { self.outline(path, stroke, context)? } else { None };
        if width >= WIDE || context.mask.is_some() {
            self.fill(outline, ink, opacity, context);
            return Ok(());
        }
        if below.is_some_and(|below| *below == ink) {
            return Ok(());
        }
        for line in self.flattened(path.data(), context)? {
            for part in self.clipped(line, context) {
                self.canvas.stroke(part, outline.as_ref(), ink.clone(), opacity);
            }
        }
        Ok(())
    }

    /// Returns the area that a stroke covers, with the gaps between its dashes.
    fn outline(
        &mut self,
        path: &Path,
        stroke: &usvg::Stroke,
        context: &Context,
    ) -> Result<Option<Region>, DrawError> {
        let mut solid = stroke.to_tiny_skia();
        solid.dash = None;
        let Some(data) = path.data().stroke(&solid, 1.0) else { return Ok(None) };
        self.filled(&data, context, Rule::NonZero)
    }

    /// Returns the parts of a line that are inside all clips. Clips for which there is too much work are left out.
    fn clipped(&mut self, line: FlatLine, context: &Context) -> Vec<FlatLine> {
        let shortest = self.tolerance();
        let count = |lines: &[FlatLine]| lines.iter().map(|line| line.points.len()).sum::<usize>();
        context.clips.iter().fold(vec![line], |lines, clip| {
            let Some((low, high)) = bounds(lines.iter().flat_map(|line| &line.points)) else { return lines };
            if clip.frames(low, high) || !self.canvas.affords(count(&lines) + clip.points()) {
                return lines;
            }
            lines.iter().flat_map(|line| clip.parts(line, true, shortest)).collect()
        })
    }

    /// Returns the area that a clip path leaves visible. `None` if nothing is left.
    fn clip(&mut self, clip: &ClipPath, transform: Transform) -> Result<Option<Region>, DrawError> {
        let inner = transform.pre_concat(clip.transform());
        let own = self.bright(clip.root(), inner, MaskType::Alpha)?;
        let Some(linked) = clip.clip_path() else { return Ok(own) };
        let other = self.clip(linked, transform)?;
        let thinnest = self.tolerance();
        Ok(own.zip(other).and_then(|(own, other)| own.common(&other, thinnest)))
    }

    /// Returns the area that a mask leaves visible. `None` if nothing is left.
    fn mask(&mut self, mask: &Mask, transform: Transform) -> Result<Option<Region>, DrawError> {
        let own = self.bright(mask.root(), transform, mask.kind())?;
        let Some(linked) = mask.mask() else { return Ok(own) };
        let other = self.mask(linked, transform)?;
        let thinnest = self.tolerance();
        Ok(own.zip(other).and_then(|(own, other)| own.common(&other, thinnest)))
    }

    /// Paints a mask or a clip path on a page of its own. Returns the bright area of the mask, or the whole area of the
    /// clip path.
    fn bright(
        &mut self,
        root: &Group,
        transform: Transform,
        kind: MaskType,
    ) -> Result<Option<Region>, DrawError> {
        let fresh = self.canvas.fresh();
        let outer = std::mem::replace(&mut self.canvas, fresh);
        let context = Context { transform, clips: Vec::new(), opacity: 1.0, mask: Some(kind) };
        let painted = self.group(root, &context);
        let painted = painted.map(|()| self.canvas.bright(MASK_MIN));
        let inner = std::mem::replace(&mut self.canvas, outer);
        self.canvas.spend(&inner);
        painted
    }
}

/// Returns the brightness that paint adds to a mask, as a grey.
fn brightness(Rgb { r, g, b }: Rgb, opacity: f64, kind: MaskType) -> Rgb {
    let light = match kind {
        MaskType::Luminance => {
            (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) * opacity
        }
        MaskType::Alpha => 255.0 * opacity,
    };
    let grey = (light + 0.5) as u8;
    Rgb::new(grey, grey, grey)
}

fn rule(rule: FillRule) -> Rule {
    match rule {
        FillRule::NonZero => Rule::NonZero,
        FillRule::EvenOdd => Rule::EvenOdd,
    }
}
