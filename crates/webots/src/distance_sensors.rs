//! Gaps to near obstacles, from Webots' distance sensors.
//!
//! The sensors are called `ps0`, `ps1` … as on the Elisa-3. `ps0` looks ahead, and the others follow clockwise at equal
//! angles. The Elisa-3 has eight sensors, our PROTO ten. The table from distances to sensor values is read from Webots,
//! so each PROTO may have its own table.

use lightbots_base::Limits;

use crate::library::{DeviceTag, LibController};
use crate::rays::gaps_m;

/// Names of the devices, clockwise from the front.
const NAMES: [&str; 10] = ["ps0", "ps1", "ps2", "ps3", "ps4", "ps5", "ps6", "ps7", "ps8", "ps9"];
/// Least number of sensors with which the readings are used: the robot core has this number of directions. With fewer,
/// the robot drives as without sensors.
const LEAST: usize = 8;
/// Distance from the robot's centre to a sensor, metres (stated in `webots/protos/LightBot.proto`).
const SENSOR_M: f64 = 0.024;
/// Radius of the Elisa-3's visible shape at the height of its sensors, metres: a white ring in its PROTO. In Webots,
/// infra-red sensors see visible shapes instead of bounding objects (reference manual, `DistanceSensor`).
const SHAPE_M: f64 = 0.021;
/// Factor from measured to true distance for the white ring of [`SHAPE_M`]: 0.2 + 0.8 · 1 · (1 − 0.5 · 0.4) (equation
/// in Webots' reference manual, `DistanceSensor`).
const REFLECTION: f64 = 0.84;

/// Type of a distance sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SensorKind {
    /// A sensor whose rays end at bounding objects.
    Bounds,
    /// A sensor whose rays end at visible shapes, and whose measured distance depends on the shape's colour.
    InfraRed,
}

/// The distance sensors of a robot.
pub(crate) struct DistanceSensors {
    /// Sensors counter-clockwise from the front.
    sensors: Vec<Sensor>,
}

struct Sensor {
    tag: DeviceTag,
    kind: SensorKind,
    table: Table,
}

impl DistanceSensors {
    /// Finds the sensors and has them sampled every `step_ms` milliseconds. `None` if the robot has fewer than `LEAST`.
    pub(crate) fn find(library: &LibController, step_ms: i32) -> Option<Self> {
        // Stops at the first missing device, because Webots prints a warning for each.
        let tags: Vec<DeviceTag> = NAMES.iter().map_while(|name| library.device(name)).collect();
        let sensor = |tag: DeviceTag| {
            library.distance_enable(tag, step_ms);
            let kind =
                if library.distance_is_infra_red(tag) { SensorKind::InfraRed } else { SensorKind::Bounds };
            Sensor { tag, kind, table: Table::new(&library.distance_table(tag)) }
        };
        let (front, others) = tags.split_first().filter(|_| tags.len() >= LEAST)?;
        let sensors = std::iter::once(front).chain(others.iter().rev()).map(|tag| sensor(*tag)).collect();
        Some(Self { sensors })
    }

    /// Gaps from the robot's rim to the rims of other robots in the eight directions of the robot core, metres,
    /// counter-clockwise from the front. Infinite if nothing is in range, and before the first sample.
    pub(crate) fn gaps_m(&self, library: &LibController) -> [f32; 8] {
        let along_m = self.sensors.iter().map(|Sensor { tag, kind, table }| {
            along_m(*kind, table.distance_m(library.distance_value(*tag)))
        });
        gaps_m(&along_m.collect::<Vec<f64>>())
    }
}

/// Gap from the robot's rim to the rim of a robot straight ahead of a sensor, metres, if the sensor measures
/// `distance_m`.
fn along_m(kind: SensorKind, distance_m: f64) -> f64 {
    let radius_m = Limits::ELISA_3.radius_m;
    let along_m = match kind {
        SensorKind::Bounds => distance_m + SENSOR_M - radius_m,
        SensorKind::InfraRed => distance_m * REFLECTION + SENSOR_M + SHAPE_M - 2.0 * radius_m,
    };
    along_m.max(0.0)
}

/// Table from distances to sensor values, linear between its rows.
struct Table {
    /// Pairs of distance in metres and sensor value, sorted by distance.
    rows: Vec<(f64, f64)>,
}

impl Table {
    /// Makes a table from rows of distance, value and noise that are sorted by distance.
    fn new(rows: &[[f64; 3]]) -> Self {
        Self { rows: rows.iter().map(|row| (row[0], row[1])).collect() }
    }

    /// Distance at which the sensor has a value, metres. Values beyond that of the first row give the distance of that
    /// row. Infinite at or beyond the value of the last row, for NaN, and for a table without rows or with equal
    /// values.
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
        // Noise may lead to values outside the table.
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
        assert_eq!(along_m(SensorKind::Bounds, f64::INFINITY), f64::INFINITY);
    }

    #[test]
    fn gaps_are_from_rim_to_rim() {
        // Centres 64 mm apart: 24 mm to the sensor, then 27 mm to the bounds, or 21 mm to the ring with its colour
        // factor.
        let (bounds, ring) = (0.064 - 0.024 - 0.027, (0.064 - 0.024 - 0.021) / 0.84);
        assert!((along_m(SensorKind::Bounds, bounds) - 0.01).abs() < 1e-12);
        assert!((along_m(SensorKind::InfraRed, ring) - 0.01).abs() < 1e-12);
        assert_eq!(along_m(SensorKind::Bounds, 0.001), 0.0);
    }
}
