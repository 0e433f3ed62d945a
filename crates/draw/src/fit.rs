//! Size and place of a picture on the floor.

use lightbots_base::Vec2;
use lightbots_base::shape::nearest_in_rect;

use crate::drawing::{Drawing, DrawingPart, Stroke};
use crate::error::DrawError;
use crate::settings::PlaceSettings;

/// If no size is set, a picture has at first at most this share of the largest size that the floor allows. It grows if
/// its lights need more room.
const SHARE: f64 = 0.8;

/// In a picture without a set size, lights are at most about this number of wanted spacings apart. Farther apart, they
/// do not look like one picture to a viewer at the edge of the floor.
const LOOSE: f64 = 4.0;

/// Where lights may stand.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureFloor {
    /// Corner with the smaller x and y of the rectangle in which robots' centres may be, stage metres.
    pub min: Vec2,
    /// Corner with the larger x and y of the rectangle in which robots' centres may be, stage metres.
    pub max: Vec2,
    /// Areas in which no robot's centre may be.
    pub no_go: Vec<NoGo>,
}

/// An area where no robot's centre may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoGo {
    /// A disc.
    Disc {
        /// Centre, stage metres.
        at: Vec2,
        /// Radius, metres. It includes the distance that a robot's centre keeps from the no-go area.
        radius_m: f64,
    },
    /// A rectangle with sides along the axes, enlarged by a margin. The enlarged area has rounded corners.
    Rect {
        /// Corner with the smaller x and y, without the margin, stage metres.
        min: Vec2,
        /// Corner with the larger x and y, without the margin, stage metres.
        max: Vec2,
        /// The margin: distance that a robot's centre keeps from the rectangle, metres.
        margin_m: f64,
    },
}

/// The map from a drawing's units to stage metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    middle: Vec2,
    extent: Vec2,
    scale: f64,
    most: f64,
    center: Vec2,
    turn: f64,
}

impl PictureFloor {
    /// A floor of this size with the origin in its middle. Robots' centres keep `margin_m` from its edges.
    pub fn new(width_m: f64, depth_m: f64, margin_m: f64) -> Self {
        let half = Vec2::new(width_m / 2.0 - margin_m, depth_m / 2.0 - margin_m);
        Self { min: half * -1.0, max: half, no_go: Vec::new() }
    }

    /// Whether a robot's centre may be at a place.
    pub fn allows(&self, at: Vec2) -> bool {
        let inside = at.x >= self.min.x && at.y >= self.min.y && at.x <= self.max.x && at.y <= self.max.y;
        inside && !self.no_go.iter().any(|area| area.holds(at))
    }
}

impl NoGo {
    fn holds(&self, at: Vec2) -> bool {
        match *self {
            Self::Disc { at: center, radius_m } => at.distance(center) < radius_m,
            Self::Rect { min, max, margin_m } => {
                let nearest = nearest_in_rect(at, min, max);
                nearest.distance(at) < margin_m || nearest == at
            }
        }
    }
}

impl Placement {
    /// Chooses the scale of a drawing: the size in `settings`, but at most the largest that the floor allows. Without a
    /// size in `settings`, it chooses one for the floor and the number of robots.
    ///
    /// # Errors
    /// A drawing without extent, or a picture whose centre is not within the edges of the floor.
    pub fn new(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Result<Self, DrawError> {
        let drawn = drawing.bounds().ok_or_else(|| {
            DrawError::new("nothing-to-draw", "there is nothing to draw; choose another source")
        })?;
        let (low, high) = settings.view.unwrap_or(drawn);
        let extent = high - low;
        if !(extent.is_finite() && extent.x.max(extent.y) > 1e-12) {
            return Err(DrawError::new(
                "nothing-to-draw",
                "the drawing is a single point; choose another source",
            ));
        }
        let mut placement = Self {
            middle: low.lerp(high, 0.5),
            extent,
            scale: 1.0,
            most: 0.0,
            center: settings.center,
            turn: settings.turn,
        };
        placement.most = placement.largest(floor);
        if placement.most <= 0.0 {
            return Err(DrawError::new("off-the-floor", "the picture's centre is not on the floor; move it"));
        }
        let larger = extent.x.max(extent.y);
        let loose = LOOSE * settings.spacing_m * ((settings.robots as f64).sqrt() + 1.0);
        placement.scale = match settings.size_m {
            Some(size) => (size / larger).min(placement.most),
            None => (SHARE * placement.most).min(loose / larger),
        };
        Ok(placement)
    }

    /// Returns the largest scale at which the box around the drawing stays within the edges of the floor after it is
    /// turned. It is not positive if the centre is outside.
    fn largest(&self, floor: &PictureFloor) -> f64 {
        let (cos, sin) = (libm::cos(self.turn).abs(), libm::sin(self.turn).abs());
        let width = self.extent.x * cos + self.extent.y * sin;
        let depth = self.extent.x * sin + self.extent.y * cos;
        let room = |center: f64, min: f64, max: f64| 2.0 * (center - min).min(max - center);
        let across = room(self.center.x, floor.min.x, floor.max.x) / width.max(1e-12);
        across.min(room(self.center.y, floor.min.y, floor.max.y) / depth.max(1e-12))
    }

    /// Larger side of the picture, metres.
    pub fn size_m(&self) -> f64 {
        self.scale * self.extent.x.max(self.extent.y)
    }

    /// Whether the picture can grow by a little more than `factor` and stay within the edges of the floor.
    pub fn has_room(&self, factor: f64) -> bool {
        self.scale * factor * 1.002 <= self.most
    }

    /// Makes the picture larger by about `factor`, as far as the edges of the floor allow, and returns the factor that
    /// was applied. `closest_m`: distance of the closest two lights at the present size.
    ///
    /// # Errors
    /// The picture fills the floor already; the message says which number of robots would fit.
    pub fn enlarge(
        &mut self,
        factor: f64,
        floor: &PictureFloor,
        settings: &PlaceSettings,
        robots: usize,
        closest_m: f64,
    ) -> Result<f64, DrawError> {
        if self.scale >= self.most * 0.999 {
            return Err(no_room(floor, settings, robots, closest_m / settings.spacing_m));
        }
        let before = self.scale;
        self.scale = (self.scale * factor * 1.002).min(self.most);
        Ok(self.scale / before)
    }

    fn map(&self, at: Vec2) -> Vec2 {
        let (cos, sin) = (libm::cos(self.turn), libm::sin(self.turn));
        let point = (at - self.middle) * self.scale;
        self.center + Vec2::new(point.x * cos - point.y * sin, point.x * sin + point.y * cos)
    }

    /// Returns the drawing in stage metres.
    pub fn apply(&self, drawing: &Drawing) -> Drawing {
        Drawing { parts: drawing.parts.iter().map(|part| self.part(part)).collect() }
    }

    fn part(&self, part: &DrawingPart) -> DrawingPart {
        let stroke = |stroke: &Stroke| Stroke {
            points: stroke.points.iter().map(|at| self.map(*at)).collect(),
            ink: stroke.ink.mapped(|at| self.map(at)),
            ..stroke.clone()
        };
        let mut mapped = part.clone();
        for area in &mut mapped.areas {
            area.rings.iter_mut().flatten().for_each(|at| *at = self.map(*at));
            area.ink = area.ink.mapped(|at| self.map(at));
        }
        mapped.strokes = part.strokes.iter().map(stroke).collect();
        mapped.spine = part.spine.iter().map(stroke).collect();
        if let Some(raster) = &mut mapped.raster {
            raster.corners = raster.corners.map(|corner| self.map(corner));
        }
        mapped
    }
}

/// Returns an error that says how many robots would fit, or how large a floor would do. `share`: distance of the
/// closest pair divided by the wanted spacing.
fn no_room(floor: &PictureFloor, settings: &PlaceSettings, robots: usize, share: f64) -> DrawError {
    let size = floor.max - floor.min;
    let refused = format!(
        "{robots} robots at least {:.0} mm apart do not fit into this picture on {:.2} × {:.2} m of floor",
        settings.spacing_m * 1_000.0,
        size.x,
        size.y
    );
    let fitting = (robots as f64 * share * share * 0.95).floor();
    let remedy = if fitting < 1.0 {
        "use fewer robots or a larger floor".to_owned()
    } else {
        format!("about {fitting} robots do, or a floor {:.1} times as wide and deep", 1.02 / share)
    };
    DrawError::new("too-many-robots", format!("{refused}; {remedy}"))
}
