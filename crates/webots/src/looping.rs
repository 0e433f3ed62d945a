//! The loop: sense, think, act, talk; once per step of the simulation.

use lightbots_base::{Instant, Limits, RobotId, Vec2};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, robot_client_id};
use lightbots_robot::{Config, Fix, Inputs, Robot};
use lightbots_wire::Topic;

use crate::pace::{Pace, Tick};
use crate::{Body, Library, MissingDevice, complain};

/// What a robot of this program needs to know.
#[derive(Clone, Debug)]
pub struct Settings {
    /// What it calls itself.
    pub id: RobotId,
    /// The broker it speaks through.
    pub broker: BrokerUrl,
    /// Leave its proximity sensors off.
    pub blind: bool,
}

/// The core is made for steps of about this length.
const STEP_MS: f64 = 16.0;
/// Messages in each direction that wait at most.
const QUEUE: usize = 256;
/// Messages handled in one step; the rest waits for the next, so that talk never delays the wheels.
const MESSAGES_A_STEP: usize = 64;

/// Drives the robot until the simulation ends. Must be called in a tokio runtime, after [`Library::init`].
pub fn drive(library: &Library, settings: &Settings) -> Result<(), MissingDevice> {
    let step_ms = step_ms(library.basic_time_step_ms());
    let mut body = Body::new(library, step_ms, settings.blind)?;
    let mut robot = Robot::new(config(settings));
    let mut link = Link::open(LinkConfig {
        broker: settings.broker.clone(),
        client_id: robot_client_id(&settings.id),
        filters: [Topic::Broadcast, Topic::Robot(settings.id)].map(|topic| topic.write().to_string()).into(),
        queue: QUEUE,
    });
    let sender = link.sender();
    let (mut pace, began) = (Pace::default(), std::time::Instant::now());
    while library.step(step_ms) {
        // Read first: what a pause of the simulation left in the queue is old news by then.
        listen(&mut robot, &mut link, own(began.elapsed()));
        let Tick { now, lag, rate } = pace.tick(library.time_s(), began.elapsed(), robot.off_m().is_some());
        let outputs = robot.step(now, &Inputs { lag, ..inputs(&mut body) });
        body.set_wheels(outputs.wheels_radps.map(|radps| radps * rate));
        body.set_light(outputs.light);
        speak(&mut robot, &sender);
    }
    Ok(())
}

/// The robot's own clock.
fn own(passed: std::time::Duration) -> Instant {
    Instant::from_secs(passed.as_secs_f64())
}

/// The smallest multiple of the world's step that is not below the core's.
fn step_ms(basic_ms: f64) -> i32 {
    let basic_ms = basic_ms.max(1.0);
    ((STEP_MS / basic_ms).ceil().max(1.0) * basic_ms) as i32
}

/// Webots' GPS and compass tell the truth without delay (measured in R2023b): a little noise is assumed all the same, so
/// that turning wheels count for something.
fn config(settings: &Settings) -> Config {
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

fn inputs(body: &mut Body<'_>) -> Inputs {
    let ([x, y], heading) = body.fix();
    let fix = (x.is_finite() && y.is_finite())
        .then(|| Fix { at: Vec2::new(x, y), heading: heading.is_finite().then_some(heading) });
    Inputs { wheel_turns_rad: body.wheel_turns_rad(), fix, proximity_m: body.gaps_m(), ..Inputs::default() }
}

fn listen(robot: &mut Robot, link: &mut Link, now: Instant) {
    for _ in 0..MESSAGES_A_STEP {
        match link.try_next() {
            Some(LinkEvent::Connected) => robot.link(now, true),
            Some(LinkEvent::Disconnected { reason }) => {
                complain(&reason);
                robot.link(now, false);
            }
            Some(LinkEvent::Message { topic, payload }) => {
                if let Some(topic) = Topic::parse(&topic) {
                    robot.receive(now, topic, &payload);
                }
            }
            None => return,
        }
    }
}

fn speak(robot: &mut Robot, sender: &Sender) {
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
