//! What is near, from Webots' distance sensors.
//!
//! The sensors are called `ps0`, `ps1` … as on the Elisa-3: `ps0` looks ahead, the others follow clockwise in even steps.
//! The Elisa-3 has eight, our PROTO ten. How far something is stands in a table from distances to values that Webots tells,
//! so that a PROTO may have any.

use lightbots_base::Limits;

use crate::library::{Library, Tag};
use crate::rays::gaps_m;

/// The devices' names, clockwise from the front.
const NAMES: [&str; 10] = ["ps0", "ps1", "ps2", "ps3", "ps4", "ps5", "ps6", "ps7", "ps8", "ps9"];
/// Fewer make no sense of what is around.
const LEAST: usize = 8;
/// From the robot's centre to a sensor, metres.
const SENSOR_M: f64 = 0.024;
/// Infra-red sensors see shapes and not bounding objects: at their height an Elisa-3's is a white ring of 21 mm, and its
/// brightness makes it look so much farther (0.2 + 0.8 · 1 · (1 − 0.5 · 0.4), Webots' reference manual).
const SHAPE_M: f64 = 0.021;
const REFLECTION: f64 = 0.84;

/// How a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// By rays that end at bounding objects.
    Bounds,
    /// By rays that end at what is drawn, and by its colour.
    InfraRed,
}

/// The sensors of a robot that has them.
pub(crate) struct Proximity {
    /// Counter-clockwise from the front.
    sensors: Vec<Sensor>,
}

struct Sensor {
    tag: Tag,
    kind: Kind,
    table: Table,
}

impl Proximity {
    /// Finds the sensors and switches them on; `None` where the robot has too few of them.
    pub(crate) fn find(library: &Library, step_ms: i32) -> Option<Self> {
        // Webots complains about every device that is not there: one complaint is enough.
        let tags: Vec<Tag> = NAMES.iter().map_while(|name| library.device(name)).collect();
        let sensor = |tag: Tag| {
            library.distance_enable(tag, step_ms);
            let kind = if library.distance_is_infra_red(tag) { Kind::InfraRed } else { Kind::Bounds };
            Sensor { tag, kind, table: Table::new(&library.distance_table(tag)) }
        };
        let (front, others) = tags.split_first().filter(|_| tags.len() >= LEAST)?;
        let sensors = std::iter::once(front).chain(others.iter().rev()).map(|tag| sensor(*tag)).collect();
        Some(Self { sensors })
    }

    /// Gaps from rim to rim, metres, counter-clockwise from the front as the core has them; infinite where nothing is
    /// in sight, and before the first sample.
    pub(crate) fn gaps_m(&self, library: &Library) -> [f32; 8] {
        let along_m = self.sensors.iter().map(|Sensor { tag, kind, table }| {
            along_m(*kind, table.distance_m(library.distance_value(*tag)))
        });
        gaps_m(&along_m.collect::<Vec<f64>>())
    }
}

/// What a distance from the sensor means from rim to rim, straight ahead of the sensor.
fn along_m(kind: Kind, distance_m: f64) -> f64 {
    let radius_m = Limits::ELISA_3.radius_m;
    let along_m = match kind {
        Kind::Bounds => distance_m + SENSOR_M - radius_m,
        Kind::InfraRed => distance_m * REFLECTION + SENSOR_M + SHAPE_M - 2.0 * radius_m,
    };
    along_m.max(0.0)
}

/// Distances and the values that stand for them, straight between its rows.
struct Table {
    /// (distance, value), by distance, metres.
    rows: Vec<(f64, f64)>,
}

impl Table {
    /// Of rows of distance, value and noise, by distance.
    fn new(rows: &[[f64; 3]]) -> Self {
        Self { rows: rows.iter().map(|row| (row[0], row[1])).collect() }
    }

    /// The distance that a value stands for; infinite at the end of what the sensor sees and where the value is none.
    fn distance_m(&self, value: f64) -> f64 {
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else { return f64::INFINITY };
        let falls = first.1 > last.1;
        let beyond = |limit: f64| if falls { value >= limit } else { value <= limit };
        if value.is_nan() || !beyond(last.1) || value == last.1 {
            return f64::INFINITY;
        }
        if beyond(first.1) {
            return first.0;
        }
        let between = self.rows.windows(2).find(|pair| beyond(pair[1].1));
        between.map_or(f64::INFINITY, |pair| {
            let ((near_m, near), (far_m, far)) = (pair[0], pair[1]);
            near_m + (far_m - near_m) * (value - near) / (far - near)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FALLING: [[f64; 3]; 3] = [[0.0, 1000.0, 0.0], [0.02, 200.0, 0.1], [0.06, 0.0, 0.0]];

    #[test]
    fn values_become_distances_again() {
        let falling = Table::new(&FALLING);
        let rising = Table::new(&[[0.0, 0.0, 0.0], [0.1, 1000.0, 0.0]]);
        let near = |found: f64, wanted: f64| (found - wanted).abs() < 1e-9;
        assert!(near(falling.distance_m(600.0), 0.01) && near(falling.distance_m(100.0), 0.04));
        assert!(near(falling.distance_m(200.0), 0.02) && near(rising.distance_m(250.0), 0.025));
        // Noise may reach beyond the table.
        assert!(near(falling.distance_m(1100.0), 0.0) && near(rising.distance_m(-1.0), 0.0));
        let nothing = [falling.distance_m(0.0), falling.distance_m(-5.0), rising.distance_m(1000.0)];
        assert_eq!(nothing, [f64::INFINITY; 3]);
    }

    #[test]
    fn what_is_no_value_is_nothing_in_sight() {
        assert_eq!(Table::new(&FALLING).distance_m(f64::NAN), f64::INFINITY);
        assert_eq!(Table::new(&[]).distance_m(5.0), f64::INFINITY);
        let flat = Table::new(&[[0.0, 7.0, 0.0], [0.1, 7.0, 0.0]]);
        assert_eq!(flat.distance_m(7.0), f64::INFINITY);
        assert_eq!(along_m(Kind::Bounds, f64::INFINITY), f64::INFINITY);
    }

    #[test]
    fn gaps_are_from_rim_to_rim() {
        // Centres 64 mm apart: the bounds are 37 mm before the centre, the ring 21 mm and by its colour farther.
        let (bounds, ring) = (0.064 - 0.024 - 0.027, (0.064 - 0.024 - 0.021) / 0.84);
        assert!((along_m(Kind::Bounds, bounds) - 0.01).abs() < 1e-12);
        assert!((along_m(Kind::InfraRed, ring) - 0.01).abs() < 1e-12);
        assert_eq!(along_m(Kind::Bounds, 0.001), 0.0);
    }
}
