//! A page that is painted from back to front. Later areas hide what is below them.

use crate::ink::Ink;
use crate::svg::flatten::FlatLine;
use crate::svg::region::{Region, bounds};

/// Paint with less opacity than this is not drawn, because it would only dim other lights. Range 0 to 1.
const FAINT: f64 = 0.1;
/// Paint with at least this opacity hides what is below it. Range 0 to 1.
const OPAQUE: f64 = 0.9;
/// Two colours look the same if every channel differs by less than this, 0 to 255.
const SHADE: i16 = 24;
/// An area is background if it covers at least this share of the page.
const BACKGROUND: f64 = 0.98;
/// Largest number of points of the areas and lines that are cut, summed over all cuts. After that, areas and lines stay
/// whole.
const WORK_MAX: usize = 3_000_000;

/// A visible area with one ink: a colour or a gradient.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The visible part.
    pub region: Region,
    /// Its colours.
    pub ink: Ink,
    /// Whether it belongs to an area that was painted over nearly the whole page.
    pub background: bool,
}

/// A visible line.
#[derive(Clone, Debug)]
pub struct Line {
    /// The visible part.
    pub line: FlatLine,
    /// Its colours.
    pub ink: Ink,
}

/// What is visible on a page after painting.
#[derive(Debug)]
pub struct Canvas {
    /// Visible areas. They overlap only if [`Self::is_overworked`] is true, or if their lines cross too often to be
    /// cut.
    pub surfaces: Vec<Surface>,
    /// Visible parts of lines.
    pub lines: Vec<Line>,
    /// Number of areas and lines fainter than [`FAINT`].
    pub faint: usize,
    /// Number of areas and lines that are wholly hidden.
    pub hidden: usize,
    /// Number of points in the cuts made until now. It is compared with [`WORK_MAX`].
    work: usize,
    /// Area of the page, square units of the page.
    page_area: f64,
    /// Areas thinner than this and lines shorter than this are dropped, units of the page.
    thinnest: f64,
}

impl Canvas {
    /// Makes an empty page.
    pub fn new(page_area: f64, thinnest: f64) -> Self {
        let (surfaces, lines) = (Vec::new(), Vec::new());
        Self { surfaces, lines, faint: 0, hidden: 0, work: 0, page_area, thinnest }
    }

    /// Makes another empty page of equal size, such as for painting a mask. The new page goes on counting work from
    /// this one.
    pub fn fresh(&self) -> Self {
        Self { work: self.work, ..Self::new(self.page_area, self.thinnest) }
    }

    /// Copies the count of work from a page that was made by [`Self::fresh`].
    pub fn spend(&mut self, other: &Self) {
        self.work = other.work;
    }

    /// Removes all areas from the page and returns the union of the bright areas; `None` if there are none. An area is
    /// bright if its green channel is at least the share `least` of 255. For greys this is the brightness.
    pub fn bright(&mut self, least: f64) -> Option<Region> {
        let surfaces = std::mem::take(&mut self.surfaces);
        let bright = surfaces.into_iter().filter(|surface| f64::from(surface.ink.color.g) >= least * 255.0);
        let regions: Vec<Region> = bright.map(|surface| surface.region).collect();
        Region::all(&regions, self.thinnest)
    }

    /// Whether the work exceeded [`WORK_MAX`]. Areas may overlap then.
    pub fn is_overworked(&self) -> bool {
        self.work > WORK_MAX
    }

    /// Adds a cut of `points` points to the count of work. Returns whether the cut may be made.
    pub fn affords(&mut self, points: usize) -> bool {
        self.work = self.work.saturating_add(points);
        !self.is_overworked()
    }

    /// Paints an area over areas and lines painted before. A nearly opaque area hides what is below it. A translucent
    /// area is mixed with the areas below, and lines stay.
    pub fn fill(&mut self, region: Region, ink: Ink, opacity: f64) {
        if opacity < FAINT {
            self.faint += 1;
            return;
        }
        if opacity >= OPAQUE {
            self.hide_lines(&region);
        }
        let background = region.area() >= BACKGROUND * self.page_area;
        if !self.surfaces.iter().any(|surface| surface.region.is_near(&region)) {
            self.surfaces.push(Surface { region, ink, background });
            return;
        }
        let mut fresh = Some(Surface { region, ink, background });
        for surface in std::mem::take(&mut self.surfaces) {
            match fresh.take() {
                Some(upper) if surface.region.is_near(&upper.region) => {
                    let points = surface.region.points() + upper.region.points();
                    fresh = if self.affords(points) {
                        self.cover(surface, upper, opacity)
                    } else {
                        self.surfaces.push(surface);
                        Some(upper)
                    };
                }
                upper => {
                    self.surfaces.push(surface);
                    fresh = upper;
                }
            }
        }
        self.surfaces.extend(fresh);
    }

    /// Keeps the part of the area `lower` that stays visible below the area `upper`. Returns the part of `upper` that
    /// is still to be painted.
    fn cover(&mut self, mut lower: Surface, mut upper: Surface, opacity: f64) -> Option<Surface> {
        let thinnest = self.thinnest;
        let mixed = if opacity >= OPAQUE {
            upper.ink.clone()
        } else {
            lower.ink.color.mixed(upper.ink.color, opacity).into()
        };
        if lower.ink == upper.ink && opacity >= OPAQUE {
            upper.region = upper.region.joined(&lower.region, thinnest).unwrap_or(upper.region);
            upper.background |= lower.background;
            return Some(upper);
        }
        if alike(&mixed, &lower.ink) {
            let rest = upper.region.minus(&lower.region, thinnest);
            self.surfaces.push(lower);
            return rest.map(|region| Surface { region, ..upper });
        }
        let both = if opacity < OPAQUE { lower.region.common(&upper.region, thinnest) } else { None };
        let rest = match &both {
            Some(_) => upper.region.minus(&lower.region, thinnest),
            None => Some(upper.region.clone()),
        };
        match lower.region.minus(&upper.region, thinnest) {
            Some(region) => {
                lower.region = region;
                self.surfaces.push(lower);
            }
            None => self.hidden += usize::from(both.is_none()),
        }
        let background = upper.background;
        self.surfaces.extend(both.map(|region| Surface { region, ink: mixed, background }));
        rest.map(|region| Surface { region, ..upper })
    }

    /// Removes the parts of lines that are below an area.
    fn hide_lines(&mut self, region: &Region) {
        for line in std::mem::take(&mut self.lines) {
            let (low, high) = region.bounds();
            let near = bounds(&line.line.points).is_some_and(|(from, to)| {
                (0..2).all(|axis| from[axis] <= high[axis] && low[axis] <= to[axis])
            });
            if !near || !self.affords(line.line.points.len() + region.points()) {
                self.lines.push(line);
                continue;
            }
            let parts = region.parts(&line.line, false, self.thinnest);
            self.hidden += usize::from(parts.is_empty());
            self.lines.extend(parts.into_iter().map(|part| Line { line: part, ink: line.ink.clone() }));
        }
    }

    /// Paints a line. `outline`: the area that the stroke covers; areas of other colours lose what is inside it.
    /// `None`: no area is cut.
    pub fn stroke(&mut self, line: FlatLine, outline: Option<&Region>, ink: Ink, opacity: f64) {
        if opacity < FAINT {
            self.faint += 1;
            return;
        }
        let recedes = |surface: &Surface| {
            surface.ink != ink && outline.is_some_and(|outline| surface.region.is_near(outline))
        };
        let surfaces = std::mem::take(&mut self.surfaces);
        for mut surface in surfaces {
            let cut = outline.filter(|_| recedes(&surface));
            if let Some(outline) = cut.filter(|cut| self.affords(surface.region.points() + cut.points())) {
                match surface.region.minus(outline, self.thinnest) {
                    Some(region) => surface.region = region,
                    None => continue,
                }
            }
            self.surfaces.push(surface);
        }
        self.lines.push(Line { line, ink });
    }
}

/// Whether two inks look the same.
fn alike(a: &Ink, b: &Ink) -> bool {
    if a.gradient.is_some() || b.gradient.is_some() {
        return a == b;
    }
    let (a, b) = (a.color, b.color);
    let near = |x: u8, y: u8| (i16::from(x) - i16::from(y)).abs() < SHADE;
    near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    const RED: Rgb = Rgb::new(255, 0, 0);
    const BLUE: Rgb = Rgb::new(0, 0, 255);

    fn square(x: f64, side: f64) -> Region {
        Region::rectangle([x, 0.0], [x + side, side])
    }

    fn canvas() -> Canvas {
        Canvas::new(10_000.0, 0.01)
    }

    fn areas(canvas: &Canvas) -> Vec<(u32, f64)> {
        let area =
            |surface: &Surface| (surface.ink.color.number(), (surface.region.area() * 100.0).round() / 100.0);
        canvas.surfaces.iter().map(area).collect()
    }

    #[test]
    fn later_areas_hide_earlier_ones() {
        let mut canvas = canvas();
        canvas.fill(square(0.0, 10.0), RED.into(), 1.0);
        canvas.fill(square(5.0, 10.0), BLUE.into(), 1.0);
        assert_eq!(areas(&canvas), [(0xff0000, 50.0), (0x0000ff, 100.0)]);
        canvas.fill(square(0.0, 20.0), RED.into(), 1.0);
        assert_eq!((areas(&canvas), canvas.hidden), (vec![(0xff0000, 400.0)], 1));
    }

    #[test]
    fn translucent_areas_mix_and_faint_ones_vanish() {
        let mut canvas = canvas();
        canvas.fill(square(0.0, 10.0), RED.into(), 1.0);
        canvas.fill(square(5.0, 10.0), BLUE.into(), 0.5);
        assert_eq!(areas(&canvas), [(0xff0000, 50.0), (0x800080, 50.0), (0x0000ff, 50.0)]);
        canvas.fill(square(0.0, 20.0), BLUE.into(), 0.05);
        assert_eq!((canvas.surfaces.len(), canvas.faint), (3, 1));
    }

    #[test]
    fn areas_hide_lines_and_recede_from_later_ones() {
        let line = || FlatLine { points: vec![[-5.0, 5.0], [15.0, 5.0]], closed: false };
        let mut canvas = canvas();
        canvas.stroke(line(), None, BLUE.into(), 1.0);
        canvas.fill(square(0.0, 10.0), RED.into(), 1.0);
        assert_eq!(canvas.lines.len(), 2);
        let outline = Region::rectangle([-5.0, 4.0], [15.0, 6.0]);
        canvas.stroke(line(), Some(&outline), BLUE.into(), 1.0);
        assert_eq!((canvas.lines.len(), areas(&canvas)), (3, vec![(0xff0000, 80.0)]));
    }

    #[test]
    fn work_is_bounded() {
        let mut canvas = canvas();
        for n in 0..2_000 {
            let shade = if n % 2 == 0 { RED } else { BLUE };
            canvas.fill(square(f64::from(n) * 1e-3, 10.0), shade.into(), 0.5);
        }
        assert!(canvas.work <= WORK_MAX || canvas.is_overworked());
        assert!(canvas.surfaces.len() < 10_000);
    }
}
