//! Places and directions on the floor.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A place or a vector on the floor, in metres and in stage space unless a name or comment says otherwise. The origin
/// of stage space is the centre of the floor, x points to the right, y up (away from the viewer).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vec2 {
    /// To the right, metres.
    pub x: f64,
    /// Away from the viewer, metres.
    pub y: f64,
}

/// Position and heading of a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Centre of the robot, stage metres.
    pub at: Vec2,
    /// Angle of its front, radians counter-clockwise from +x.
    pub heading: f64,
}

impl Vec2 {
    /// The origin.
    pub const ZERO: Self = Self::new(0.0, 0.0);

    /// A vector of two coordinates.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The unit vector in direction `angle`, radians counter-clockwise from +x.
    pub fn unit(angle: f64) -> Self {
        Self::new(libm::cos(angle), libm::sin(angle))
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// z component of the vector product; positive if the direction `other` is to the left of `self`.
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Length squared.
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    pub fn length(self) -> f64 {
        libm::sqrt(self.length_squared())
    }

    /// Distance between two places.
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// The vector's angle, radians counter-clockwise from +x, in [−π, π]; 0 for [`Vec2::ZERO`].
    pub fn angle(self) -> f64 {
        libm::atan2(self.y, self.x)
    }

    /// The vector rotated by a quarter turn to the left.
    pub fn left(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// The point at `share` of the straight line from this place to `other`: 0 is this place, 1 is `other`.
    pub fn lerp(self, other: Self, share: f64) -> Self {
        self + (other - self) * share
    }

    /// The vector scaled to length 1; `None` if its length is at most 1e-12 or not finite.
    pub fn normalized(self) -> Option<Self> {
        let length = self.length();
        (length > 1e-12 && length.is_finite()).then(|| self / length)
    }

    /// Whether both coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Pose {
    /// A pose from a place and a heading.
    pub const fn new(at: Vec2, heading: f64) -> Self {
        Self { at, heading }
    }
}

impl Add for Vec2 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl AddAssign for Vec2 {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Vec2 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl SubAssign for Vec2 {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Mul<f64> for Vec2 {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}

impl Div<f64> for Vec2 {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self::new(self.x / divisor, self.y / divisor)
    }
}

impl Neg for Vec2 {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}
