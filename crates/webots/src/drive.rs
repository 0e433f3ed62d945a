//! The control loop of the driver. In each step of the simulation it receives messages, reads sensors, runs the robot
//! core, commands the motors, and sends messages.

use lightbots_base::{Instant, Limits, RobotId, Vec2};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, robot_client_id};
use lightbots_robot::{Config, Fix, Inputs, Robot};
use lightbots_wire::Topic;

use crate::world_clock::{Tick, WorldClock};
use crate::{LibController, MissingDevice, WebotsBody, print_problem};

/// Settings of the driver.
#[derive(Clone, Debug)]
pub struct DriverSettings {
    /// Name of the robot.
    pub id: RobotId,
    /// Broker.
    pub broker: BrokerUrl,
    /// Whether the proximity sensors stay switched off.
    pub blind: bool,
}

/// Wanted step of the robot core, milliseconds, as in the simulator (docs/simulator.md). With 32 ms, robots deviate on
/// curves (docs/webots.md).
const STEP_MS: f64 = 16.0;
/// Largest number of queued messages in each direction: four times `MESSAGES_PER_STEP`. With a smaller value, messages
/// are dropped when many arrive in one step.
const QUEUE: usize = 256;
/// Largest number of messages handled in one step. The others wait for the next step, so that messages never delay the
/// wheels.
const MESSAGES_PER_STEP: usize = 64;

/// Drives the robot until the simulation ends. Call it in a tokio runtime, after [`LibController::init`]. An error if
/// the robot lacks a required device.
pub fn drive(library: &LibController, settings: &DriverSettings) -> Result<(), MissingDevice> {
    let step_ms = step_ms(library.basic_time_step_ms());
    let mut body = WebotsBody::new(library, step_ms, settings.blind)?;
    let mut robot = Robot::new(config(settings));
    let mut link = Link::open(LinkConfig {
        broker: settings.broker.clone(),
        client_id: robot_client_id(&settings.id),
        filters: [Topic::Broadcast, Topic::Robot(settings.id)].map(|topic| topic.write().to_string()).into(),
        queue: QUEUE,
    });
    let sender = link.sender();
    let (mut clock, began) = (WorldClock::default(), std::time::Instant::now());
    while library.step(step_ms) {
        // Received first, because messages that waited during a pause of the simulation must not act late.
        receive(&mut robot, &mut link, own(began.elapsed()));
        let Tick { now, lag, rate } = clock.tick(library.time_s(), began.elapsed(), robot.off_m().is_some());
        let outputs = robot.step(now, &Inputs { lag, ..inputs(&mut body) });
        body.set_wheels(outputs.wheels_radps.map(|radps| radps * rate));
        body.set_light(outputs.light);
        send(&mut robot, &sender);
    }
    Ok(())
}

/// Converts the real time since the start of this process to the robot's own clock.
fn own(passed: std::time::Duration) -> Instant {
    Instant::from_secs(passed.as_secs_f64())
}

/// Returns the step of the driver, milliseconds: the smallest multiple of the world's step `basic_ms` that is at least
/// `STEP_MS`.
fn step_ms(basic_ms: f64) -> i32 {
    let basic_ms = basic_ms.max(1.0);
    ((STEP_MS / basic_ms).ceil().max(1.0) * basic_ms) as i32
}

/// Configuration of the robot core. Webots' GPS and compass are exact and without delay (measured in R2023b). A small
/// noise is assumed all the same, so that the filter also uses the wheels.
fn config(settings: &DriverSettings) -> Config {
    let seed = settings
        .id
        .as_str()
        .bytes()
        .fold(0_u32, |sum, byte| sum.wrapping_mul(31).wrapping_add(u32::from(byte)));
    Config {
        limits: Limits::ELISA_3,
        seed,
        fix_sigma_m: 0.0005,
        heading_sigma_rad: 0.002,
        simulated: true,
        ..Config::new(settings.id)
    }
}

fn inputs(body: &mut WebotsBody<'_>) -> Inputs {
    let ([x, y], heading) = body.fix();
    let fix = (x.is_finite() && y.is_finite())
        .then(|| Fix { at: Vec2::new(x, y), heading: heading.is_finite().then_some(heading) });
    Inputs { wheel_turns_rad: body.wheel_turns_rad(), fix, proximity_m: body.gaps_m(), ..Inputs::default() }
}

fn receive(robot: &mut Robot, link: &mut Link, now: Instant) {
    for _ in 0..MESSAGES_PER_STEP {
        match link.try_next() {
            Some(LinkEvent::Connected) => robot.link(now, true),
            Some(LinkEvent::Disconnected { reason }) => {
                print_problem(&reason);
                robot.link(now, false);
            }
            Some(LinkEvent::Message { topic, payload, .. }) => {
                if let Some(topic) = Topic::parse(&topic) {
                    robot.receive(now, topic, &payload);
                }
            }
            None => return,
        }
    }
}

fn send(robot: &mut Robot, sender: &Sender) {
    let mut payload = Default::default();
    while let Some(topic) = robot.outgoing(&mut payload) {
        sender.send(&topic.write(), payload.as_bytes().to_vec());
        payload.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::step_ms;

    #[test]
    fn the_step_fits_the_world() {
        assert_eq!([step_ms(16.0), step_ms(32.0), step_ms(8.0), step_ms(10.0)], [16, 32, 16, 20]);
    }
}
