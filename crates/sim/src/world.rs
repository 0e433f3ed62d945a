//! The world: bodies that drive, slip and push each other on a floor.

use lightbots_base::{Pose, Span, StateHash, Vec2, wrap};
use lightbots_show::Stage;

use crate::bumps::{Against, Bumps};
use crate::contacts::{ContactState, Contacts};
use crate::dice::{Dice, Purpose};
use crate::drive_train::DriveTrain;
use crate::floor::Floor;
use crate::neighbour_list::NeighbourList;
use crate::proximity::ProximityReadings;
use crate::wheel_slip::WheelSlip;

/// Duration of a step of the world. It equals the step of the Webots world and of a robot's control loop.
pub const STEP: Span = Span::from_millis(16);

/// [`STEP`] in seconds.
pub(crate) const STEP_S: f64 = 0.016;

/// The bodies of robots on a floor. Each kind of state has its own array, indexed by robot, so that the search for
/// contacts reads only places.
#[derive(Clone, Debug)]
pub struct World {
    places: Vec<Vec2>,
    contact_states: Vec<ContactState>,
    axles: Vec<Axle>,
    bodies: Vec<Body>,
    floor: Floor,
    near: NeighbourList,
    contacts: Contacts,
    proximity: ProximityReadings,
    slip: f64,
    dice: Dice,
    bumps: Bumps,
}

/// Body state that a robot's firmware reads or writes.
#[derive(Clone, Debug)]
struct Axle {
    /// Commanded wheel rates, left and right, rad/s.
    commanded: [f64; 2],
    /// Wheel rates in the last step, left and right, rad/s.
    wheels: [f64; 2],
    /// Heading in the stage, radians, counter-clockwise from the x axis.
    heading: f64,
}

#[derive(Clone, Debug)]
struct Body {
    drive: DriveTrain,
    slip: WheelSlip,
    /// Share of the left wheel's turning that moves the body, apart from slip: 1 unless that wheel is worn.
    left_share: f64,
    /// The contact with a wall or no-go area that the body is pressed against; `None`: it touches none.
    against: Option<Against>,
}

impl World {
    /// A world with robots at rest at the poses `starts`. `slip`: mean share of a wheel's turning that does not move
    /// the body.
    pub fn new(stage: &Stage, starts: &[Pose], slip: f64, seed: u64) -> Self {
        Self::with_people(stage, starts, false, slip, seed)
    }

    /// Makes a world as [`Self::new`] does. If `has_people`, one more disc follows the robots: a foot, which stands
    /// beside the floor until [`Self::put_foot`].
    pub(crate) fn with_people(
        stage: &Stage,
        robots: &[Pose],
        has_people: bool,
        slip: f64,
        seed: u64,
    ) -> Self {
        let mut dice = Dice::new(seed, Purpose::Slip);
        let places: Vec<Vec2> = robots.iter().map(|start| start.at).collect();
        let floor = Floor::new(stage, &places);
        let foot = has_people.then(|| Pose::new(beside(stage), 0.0));
        let starts: Vec<Pose> = robots.iter().copied().chain(foot).collect();
        let places: Vec<Vec2> = starts.iter().map(|start| start.at).collect();
        let body = |_: &Pose| Body {
            drive: DriveTrain::default(),
            slip: WheelSlip::new(slip, &mut dice),
            left_share: 1.0,
            against: None,
        };
        let axle =
            |start: &Pose| Axle { commanded: [0.0; 2], wheels: [0.0; 2], heading: wrap(start.heading) };
        let (contact_m, sight_m) =
            (stage.limits.contact_m(), ProximityReadings::sight_m(stage.limits.radius_m));
        let bodies = starts.iter().map(body).collect();
        Self {
            contact_states: starts.iter().map(|start| ContactState::new(Vec2::unit(start.heading))).collect(),
            floor,
            near: NeighbourList::new(sight_m),
            contacts: Contacts::new(contact_m, sight_m),
            proximity: ProximityReadings::new(starts.len(), stage.limits.radius_m, seed),
            bumps: Bumps::default(),
            places,
            axles: starts.iter().map(axle).collect(),
            bodies,
            slip,
            dice,
        }
    }

    /// Makes the left wheel of a robot move the body by only this share of its turning.
    pub(crate) fn wear(&mut self, robot: usize, share: f64) {
        if let Some(body) = self.bodies.get_mut(robot) {
            body.left_share = share;
        }
    }

    /// Puts the person's foot at `place` on the floor; `None`: beside the floor.
    pub(crate) fn put_foot(&mut self, stage: &Stage, place: Option<Vec2>) {
        self.put(self.places.len() - 1, place.unwrap_or_else(|| beside(stage)));
    }

    /// Commands the wheel rates of a robot, left and right, rad/s. The next step still drives with the old rates; the
    /// new ones act from the step after it.
    #[inline]
    pub fn command(&mut self, robot: usize, wheels_radps: [f64; 2]) {
        self.axles[robot].commanded = wheels_radps;
    }

    /// Wheel turns of a robot in the last step, left and right, radians.
    #[inline]
    pub fn wheel_turns(&self, robot: usize) -> [f64; 2] {
        let [left, right] = self.axles[robot].wheels;
        [left * STEP_S, right * STEP_S]
    }

    /// Readings of a robot's proximity sensors, counter-clockwise from the front, metres; infinite if nothing is in
    /// range.
    #[inline]
    pub fn proximity_m(&self, robot: usize) -> [f32; 8] {
        self.proximity.gaps_m(robot)
    }

    /// True pose of a robot.
    #[inline]
    pub fn pose(&self, robot: usize) -> Pose {
        Pose { at: self.places[robot], heading: self.axles[robot].heading }
    }

    /// True places of all robots, stage metres. With people, the last place is that of the foot.
    pub fn places(&self) -> &[Vec2] {
        &self.places
    }

    /// Whether the robot could stand at `place`: on the floor, outside of no-go areas, and at least `gap_m` (metres,
    /// rim to rim) from all others.
    pub(crate) fn is_free(&self, robot: usize, place: Vec2, gap_m: f64) -> bool {
        let clear_m = self.contacts.contact_m() + gap_m;
        let mut kept = place;
        self.floor.keep_out(&mut kept).is_none()
            && (0..self.places.len())
                .all(|other| other == robot || self.places[other].distance(place) >= clear_m)
    }

    /// Lifts a robot and puts it down at a place.
    pub(crate) fn put(&mut self, robot: usize, place: Vec2) {
        self.places[robot] = place;
        self.near.rebuild(&self.places);
    }

    /// Contacts between robots.
    pub fn contacts(&self) -> &Contacts {
        &self.contacts
    }

    /// Contacts with walls and no-go areas.
    pub fn bumps(&self) -> &Bumps {
        &self.bumps
    }

    /// Moves all bodies by one step of 16 ms.
    pub fn step(&mut self) {
        let (mut moved, mut outdated) = (false, false);
        self.bumps.begin_step();
        for robot in 0..self.bodies.len() {
            // The place is returned by value: reading it back as a whole just after its halves were written would stall.
            if let Some(place) = self.move_body(robot) {
                moved = true;
                outdated |= self.near.outdated_by(robot, place);
            }
        }
        if !moved && self.contacts.none_touching() {
            return;
        }
        if outdated {
            self.near.rebuild(&self.places);
        }
        self.contacts.resolve(self.near.pairs(), &mut self.places, &mut self.contact_states);
        self.proximity.sample(self.contacts.in_sight(), &self.places, &self.contact_states);
    }

    /// Adds the places and headings of all bodies to a hash.
    pub fn imprint(&self, hash: &mut StateHash) {
        for (place, axle) in self.places.iter().zip(&self.axles) {
            hash.number(place.x);
            hash.number(place.y);
            hash.number(axle.heading);
        }
    }

    /// Moves a body by one step. Returns the new place of its centre; `None` if the body rests.
    #[inline]
    fn move_body(&mut self, robot: usize) -> Option<Vec2> {
        let body = &mut self.bodies[robot];
        let axle = &mut self.axles[robot];
        let contact_state = &mut self.contact_states[robot];
        if axle.commanded == [0.0; 2] && body.drive.rests() {
            contact_state.stands = true;
            return None;
        }
        let [left, right] = body.slip.grip(self.slip, &mut self.dice);
        let twist = body.drive.step(axle.commanded, [left * body.left_share, right]);
        axle.wheels = body.drive.wheels();
        contact_state.stands = twist.speed_mps == 0.0 && twist.turn_radps == 0.0;
        let half_turn = 0.5 * STEP_S * twist.turn_radps;
        let middle = turned(contact_state.forward, half_turn);
        contact_state.forward = turned(middle, half_turn);
        axle.heading = wrap(axle.heading + 2.0 * half_turn);
        let mut place = self.places[robot] + middle * (STEP_S * twist.speed_mps);
        let out_of = self.floor.keep_out(&mut place);
        if out_of.is_some() || body.against.is_some() {
            body.against = self.bumps.update(robot, body.against, out_of, &self.floor, place);
        }
        self.places[robot] = place;
        Some(place)
    }
}

/// A place beside the floor that no robot's sensors reach, stage metres.
fn beside(stage: &Stage) -> Vec2 {
    Vec2::new(0.5 * stage.width_m + 1.0, 0.0)
}

/// The vector `unit` rotated counter-clockwise by `angle`, radians, below 0.3. A Taylor series replaces sine and
/// cosine. The result is scaled back to length 1, because errors would add up.
#[inline]
fn turned(unit: Vec2, angle: f64) -> Vec2 {
    if angle == 0.0 {
        return unit;
    }
    let square = angle * angle;
    let sine = angle * (1.0 - square * (1.0 / 6.0) * (1.0 - square * (1.0 / 20.0)));
    let cosine = 1.0 - 0.5 * square * (1.0 - square * (1.0 / 12.0) * (1.0 - square * (1.0 / 30.0)));
    let turned = Vec2::new(unit.x * cosine - unit.y * sine, unit.x * sine + unit.y * cosine);
    turned * (1.5 - 0.5 * turned.length_squared())
}

#[cfg(test)]
#[path = "world_tests.rs"]
mod tests;
