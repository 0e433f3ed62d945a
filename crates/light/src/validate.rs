//! Validates layers: finds what is wrong with them, with a remedy for each fault.

use crate::effect::{Coordinate, LightEffect};
use crate::layer::LightLayer;
use crate::mask::{LightMask, MaskShape};
use core::fmt::Display;

/// Largest number of layers, equal to `lightbots_show::MAX_LAYERS`: each layer costs time for every colour of a robot.
pub const LAYERS_MAX: usize = 1_000;
/// Largest number of faults that are reported at once, chosen by us: people mend the first faults and check again.
pub const FAULTS_MAX: usize = 100;
/// Largest number of points of an opacity curve, chosen by us: one every 0.36 s of an hour.
pub const CURVE_POINTS_MAX: usize = 10_000;
/// Largest number of stops of a palette, chosen by us.
pub const STOPS_MAX: usize = 64;
/// Largest number of masks of a layer, chosen by us. Each mask costs time for every colour of a robot.
pub const MASKS_MAX: usize = 16;
/// Largest number of points of a polygon or a curve, chosen by us. Each point costs time for every colour of a robot.
pub const OUTLINE_POINTS_MAX: usize = 1_000;
/// Largest number of pixels of a selection: the largest number of pixels in a frame (`lightbots_show::MAX_PIXELS`).
pub const SELECTION_MAX: usize = 20_000;
/// Largest number of octaves of noise, chosen by us: cells of the eighth octave are about a hundredth of the effect's size.
pub const OCTAVES_MAX: u32 = 8;
/// Largest magnitude of `speed_hz` of the effects strobe and pulse, in which all robots flash together, hertz. WCAG 2.2,
/// 2.3.1, allows three flashes in any second.
pub const FLASHING_MAX_HZ: f64 = 3.0;
/// Largest magnitude of `speed_hz` of other effects, hertz: a light track has 100 samples a second, five for each cycle.
pub const SPEED_MAX_HZ: f64 = 20.0;
/// Smallest and largest size of an effect, metres, chosen by us. Details smaller than a robot (0.07 m) cannot be seen.
pub const SIZE_RANGE_M: (f64, f64) = (0.01, 1_000.0);
/// Largest magnitude of a coordinate, metres, chosen by us: beyond any floor.
pub const COORDINATE_MAX_M: f64 = 1_000.0;
/// Largest magnitude of a moment, seconds, chosen by us: a day.
pub const MOMENT_MAX_S: f64 = 86_400.0;
/// Shortest time between two rows of a sequence, seconds. Light tracks resolve only 0.01 s.
pub const SEQUENCE_STEP_MIN_S: f64 = 0.001;
/// Smallest share of a cycle that may shine. In a cycle of a second it is 10 ms, the time between two samples of a track.
pub const WIDTH_MIN: f64 = 0.01;

/// Something wrong with a layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayerFault {
    /// Number of the layer, counted from 0; `None`: all layers together.
    pub layer: Option<usize>,
    /// The wrong field, such as `speed_hz`.
    pub field: &'static str,
    /// The wrong value of the field.
    pub value: String,
    /// What to do, for people.
    pub remedy: String,
}

/// Such as "layer 2: speed_hz is 1000: choose a number from -3 to 3".
impl Display for LayerFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.layer {
            Some(number) => write!(f, "layer {}: ", number + 1)?,
            None => write!(f, "layers: ")?,
        }
        write!(f, "{} is {}: {}", self.field, self.value, self.remedy)
    }
}

/// Returns the faults of all layers, at most [`FAULTS_MAX`].
pub(crate) fn faults(layers: &[LightLayer]) -> Vec<LayerFault> {
    let mut found = Found::default();
    found.count("number of layers", layers.len(), LAYERS_MAX);
    // Layers beyond `LAYERS_MAX` are not checked, because the first fault says that there are too many.
    for (number, layer) in layers.iter().take(LAYERS_MAX).enumerate() {
        found.layer = Some(number);
        found.times(layer);
        found.look(layer);
        found.effect(&layer.effect);
        found.count("number of masks", layer.masks.len(), MASKS_MAX);
        layer.masks.iter().take(MASKS_MAX).for_each(|mask| found.mask(mask));
        if found.list.len() >= FAULTS_MAX {
            break;
        }
    }
    found.list.truncate(FAULTS_MAX);
    found.list
}

#[derive(Default)]
struct Found {
    layer: Option<usize>,
    list: Vec<LayerFault>,
}

impl Found {
    fn add(&mut self, field: &'static str, value: impl Display, remedy: impl Into<String>) {
        let fault = LayerFault { layer: self.layer, field, value: value.to_string(), remedy: remedy.into() };
        self.list.push(fault);
    }

    /// Adds a fault if `value` is outside of the range from `least` to `most`, both included, or NaN.
    fn range(&mut self, field: &'static str, value: f64, (least, most): (f64, f64)) {
        if !(least <= value && value <= most) {
            self.add(field, value, format!("choose a number from {least} to {most}"));
        }
    }

    fn share(&mut self, field: &'static str, value: f64) {
        self.range(field, value, (0.0, 1.0));
    }

    fn place(&mut self, field: &'static str, place: lightbots_base::Vec2) {
        self.range(field, place.x, (-COORDINATE_MAX_M, COORDINATE_MAX_M));
        self.range(field, place.y, (-COORDINATE_MAX_M, COORDINATE_MAX_M));
    }

    fn count(&mut self, field: &'static str, count: usize, most: usize) {
        if count > most {
            self.add(field, count, format!("{most} are the most; leave some out"));
        }
    }

    /// Adds one fault if a value is less than the value before it. Ignores NaN, which `range` reports.
    fn order(&mut self, field: &'static str, values: impl Iterator<Item = f64> + Clone) {
        let wrong = values.clone().zip(values.skip(1)).find(|(first, second)| first > second);
        if let Some((first, second)) = wrong {
            self.add(field, format!("{first}, then {second}"), "put them in increasing order");
        }
    }

    fn times(&mut self, layer: &LightLayer) {
        self.range("from_s", layer.from_s, (-MOMENT_MAX_S, MOMENT_MAX_S));
        self.range("origin_s", layer.origin_s, (-MOMENT_MAX_S, MOMENT_MAX_S));
        if layer.to_s.is_nan() || layer.to_s <= layer.from_s {
            self.add("to_s", layer.to_s, "choose a moment after from_s");
        }
        let points = &layer.opacity.points;
        self.count("number of points of the opacity curve", points.len(), CURVE_POINTS_MAX);
        if points.is_empty() {
            self.add("number of points of the opacity curve", 0, "give at least one");
        }
        let moments = points.iter().map(|point| point.0).take(CURVE_POINTS_MAX);
        for &(moment_s, opacity) in points.iter().take(CURVE_POINTS_MAX) {
            self.range("moment of the opacity curve", moment_s, (-MOMENT_MAX_S, MOMENT_MAX_S));
            self.share("opacity", opacity);
            if self.list.len() >= FAULTS_MAX {
                return;
            }
        }
        self.order("moment of the opacity curve", moments);
    }

    fn look(&mut self, layer: &LightLayer) {
        let look = &layer.look;
        self.place("place", look.place);
        self.range("angle", look.angle, (-1_000.0, 1_000.0));
        self.range("size_m", look.size_m, SIZE_RANGE_M);
        self.range("width", look.width, (WIDTH_MIN, 1.0));
        let flashing = matches!(layer.effect, LightEffect::Strobe | LightEffect::Pulse);
        let most_hz = if flashing { FLASHING_MAX_HZ } else { SPEED_MAX_HZ };
        self.range("speed_hz", look.speed_hz, (-most_hz, most_hz));
        let stops = &look.palette.stops;
        self.count("number of stops", stops.len(), STOPS_MAX);
        if stops.is_empty() {
            self.add("number of stops", 0, "give at least one colour");
        }
        for stop in stops.iter().take(STOPS_MAX) {
            self.share("position of a stop", stop.at);
            self.share("opacity of a stop", stop.opacity);
            for light in [stop.colour.r, stop.colour.g, stop.colour.b] {
                self.share("light of a stop", light);
            }
        }
        self.order("position of a stop", stops.iter().map(|stop| stop.at).take(STOPS_MAX));
    }

    fn effect(&mut self, effect: &LightEffect) {
        match effect {
            LightEffect::Twinkle { density } | LightEffect::Sparkle { density } => {
                self.share("density", *density)
            }
            LightEffect::Rainbow { along, saturation } => {
                self.share("saturation", *saturation);
                self.coordinate(along);
            }
            LightEffect::Gradient(along) | LightEffect::Wave(along) | LightEffect::Chase(along) => {
                self.coordinate(along);
            }
            LightEffect::Noise { octaves } if !(1..=OCTAVES_MAX).contains(octaves) => {
                self.add("octaves", octaves, format!("choose a number from 1 to {OCTAVES_MAX}"));
            }
            LightEffect::Sequence { step_s, start_s, .. } => {
                self.range("step_s", *step_s, (SEQUENCE_STEP_MIN_S, MOMENT_MAX_S));
                self.range("start_s", *start_s, (-MOMENT_MAX_S, MOMENT_MAX_S));
            }
            // A robot drives at most 0.3 m/s; 100 m/s is a mistake.
            LightEffect::BySpeed { top_mps } => self.range("top_mps", *top_mps, (0.001, 100.0)),
            _ => {}
        }
    }

    fn coordinate(&mut self, along: &Coordinate) {
        if let Coordinate::Curve(points) = along {
            self.outline("number of points of the curve", points, 2);
        }
    }

    fn outline(&mut self, field: &'static str, points: &[lightbots_base::Vec2], least: usize) {
        self.count(field, points.len(), OUTLINE_POINTS_MAX);
        if points.len() < least {
            self.add(field, points.len(), format!("give at least {least}"));
        }
        points.iter().take(OUTLINE_POINTS_MAX).for_each(|&point| self.place("point", point));
    }

    fn mask(&mut self, mask: &LightMask) {
        self.range("feather_m", mask.feather_m, (0.0, SIZE_RANGE_M.1));
        match &mask.shape {
            MaskShape::Selection(ids) => {
                self.count("number of selected pixels", ids.len(), SELECTION_MAX);
                self.order("selected pixel", ids.iter().take(SELECTION_MAX).map(|&id| f64::from(id)));
            }
            MaskShape::Frames { first, last } if first > last => {
                self.add("frames", format!("{first} to {last}"), "put the first frame first");
            }
            MaskShape::Frames { .. } => {}
            MaskShape::Rectangle { centre, half, angle } => {
                self.place("centre", *centre);
                self.range("half", half.x, (0.0, COORDINATE_MAX_M));
                self.range("half", half.y, (0.0, COORDINATE_MAX_M));
                self.range("angle", *angle, (-1_000.0, 1_000.0));
            }
            MaskShape::Circle { centre, radius_m } => {
                self.place("centre", *centre);
                self.range("radius_m", *radius_m, (0.0, COORDINATE_MAX_M));
            }
            MaskShape::Polygon(corners) => self.outline("number of corners", corners, 3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Layers, Look, OpacityCurve};

    fn first_fault(change: impl Fn(&mut LightLayer)) -> String {
        let mut layer = LightLayer::new(LightEffect::Strobe, Look::default());
        change(&mut layer);
        Layers::new(vec![layer]).expect_err("the layer is wrong")[0].to_string()
    }

    #[test]
    fn absurd_layers_are_named_with_value_and_remedy() {
        let strobe = first_fault(|layer| layer.look.speed_hz = 1_000.0);
        assert_eq!(strobe, "layer 1: speed_hz is 1000: choose a number from -3 to 3");
        let place = first_fault(|layer| layer.look.place.y = f64::NAN);
        assert_eq!(place, "layer 1: place is NaN: choose a number from -1000 to 1000");
        let curve = first_fault(|layer| layer.opacity = OpacityCurve { points: vec![(0.0, 0.5); 1_000_000] });
        let wanted =
            "layer 1: number of points of the opacity curve is 1000000: 10000 are the most; leave some out";
        assert_eq!(curve, wanted);
        let ends = first_fault(|layer| layer.to_s = f64::NAN);
        assert_eq!(ends, "layer 1: to_s is NaN: choose a moment after from_s");
    }

    #[test]
    fn too_many_layers_are_one_fault() {
        let layers = vec![LightLayer::new(LightEffect::Solid, Look::default()); 100_000];
        let faults = Layers::new(layers).expect_err("these are too many");
        assert_eq!(faults.len(), 1);
        assert_eq!(
            faults[0].to_string(),
            "layers: number of layers is 100000: 1000 are the most; leave some out"
        );
    }

    #[test]
    fn faults_are_bounded() {
        let mut layer = LightLayer::new(LightEffect::Solid, Look::default());
        layer.opacity.points = vec![(f64::NAN, f64::NAN); CURVE_POINTS_MAX];
        assert_eq!(Layers::new(vec![layer; 10]).expect_err("all are wrong").len(), FAULTS_MAX);
    }
}
