//! Measures and limits of a robot's body.

/// Measures and limits of one kind of robot. The default is the GCtronic Elisa-3, measured in Webots R2023b on
/// 2026-11-21. Its speed follows ramps of 1 m/s² within 5 mm/s, and it stops from a turn of 4.5 rad/s within 1°.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// Radius of the disc that stands for the body, metres.
    pub radius_m: f64,
    /// Highest planned speed, m/s.
    pub speed_mps: f64,
    /// Highest planned acceleration, m/s²: the length of the vector, with its parts along and across the path.
    pub accel_mps2: f64,
    /// Highest planned turning rate, rad/s.
    pub turn_radps: f64,
    /// Highest rate of a wheel motor, rad/s.
    pub wheel_radps: f64,
    /// Radius of a wheel, metres.
    pub wheel_radius_m: f64,
    /// Effective distance between the two wheels (track width), metres.
    pub track_m: f64,
}

impl Limits {
    /// The GCtronic Elisa-3, measured in Webots R2023b on 2026-11-21.
    pub const ELISA_3: Self = Self {
        radius_m: 0.027,
        speed_mps: 0.27,
        accel_mps2: 1.0,
        turn_radps: 4.5,
        wheel_radps: 133.0,
        wheel_radius_m: 0.0045,
        track_m: 0.0402,
    };

    /// Distance between the centres of two robots at which their rims touch, metres: twice the radius.
    pub const fn contact_m(&self) -> f64 {
        2.0 * self.radius_m
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self::ELISA_3
    }
}
