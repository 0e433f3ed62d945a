//! The floor for the drivers' processes: our simulated world behind the stand-in's socket, at the pace of a Webots.

use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use Controller::motor::Motor;
use Controller::proximity::RAYS;
use Controller::socket::{StepCommand, StepReply, read_name};
use lightbots_base::{Pose, Vec2};
use lightbots_show::Stage;
use lightbots_sim::{STEP, World};

use crate::eyes::Eyes;
use crate::pace::{Pace, Steps};
use crate::processes::PATIENCE;

/// The results of a simulation.
#[derive(Debug)]
pub struct Account {
    /// Number of contacts between robots. A pair that parts and touches again counts again.
    pub contacts: u64,
    /// Least distance between two centres, metres.
    pub closest_m: Option<f64>,
    /// The last colour of each robot's light.
    pub colours: Vec<u32>,
    /// Places of the robots at the end.
    pub places: Vec<Vec2>,
    /// The track of each robot, `[robot][sample]`: real time and place, every `STEPS_A_PLACE` steps.
    pub tracks: Vec<Vec<(Instant, Vec2)>>,
    /// Simulated seconds per real second, pauses included.
    pub rate: f64,
}

/// Number of steps between two samples of a track.
pub const STEPS_A_PLACE: u32 = 6;

/// A floor, and the thread that steps it.
pub struct Floor {
    stop: Arc<AtomicBool>,
    steps: Arc<AtomicU32>,
    thread: JoinHandle<Account>,
}

impl Floor {
    /// Listens at `address` and begins when `processes` drivers are connected. Robot `LightBot n` stands at the start
    /// with index `n - 1`. Robots without power stand at further starts.
    pub fn open(
        address: &Path,
        stage: &Stage,
        starts: &[Vec2],
        processes: usize,
        (pace, seed): (Pace, u64),
    ) -> Self {
        let listener = UnixListener::bind(address).expect("the socket's path is free");
        let poses: Vec<Pose> = starts.iter().map(|at| Pose::new(*at, std::f64::consts::FRAC_PI_2)).collect();
        let world = World::new(stage, &poses, 0.0, seed);
        let (stop, steps) = (Arc::<AtomicBool>::default(), Arc::<AtomicU32>::default());
        let (asked, taken) = (stop.clone(), steps.clone());
        let paces = Steps::new(pace, STEP.as_secs(), seed);
        let thread = std::thread::spawn(move || run(&listener, world, processes, paces, (&asked, &taken)));
        Self { stop, steps, thread }
    }

    /// Waits until this much more simulated time has passed.
    pub fn wait(&self, simulated_s: f64) {
        let until = self.steps.load(Ordering::Acquire) + (simulated_s / STEP.as_secs()) as u32;
        let late = Instant::now() + PATIENCE;
        while self.steps.load(Ordering::Acquire) < until {
            assert!(Instant::now() < late, "the floor does not go on");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Ends the simulation as Webots does. Returns its results.
    pub fn close(self) -> Account {
        self.stop.store(true, Ordering::Release);
        self.thread.join().expect("the floor ran to its end")
    }
}

/// A robot on the floor, and the connection to its driver.
struct Body {
    /// The connection. `None` once the process has ended, because Webots continues without it.
    process: Option<UnixStream>,
    command: StepCommand,
    /// Wheel turns that the position sensors report, radians: less than the wheels really turned.
    read_rad: [f64; 2],
    track: Vec<(Instant, Vec2)>,
}

impl Body {
    /// Waits for the driver's command. The whole world waits for it in every step.
    fn listen(&mut self) {
        if let Some(process) = &mut self.process {
            match StepCommand::read(process) {
                Ok(command) => self.command = command,
                Err(_) => self.process = None,
            }
        }
    }

    fn wheels_radps(&self) -> [f64; 2] {
        [0, 1].map(|side| Motor::rate_radps(&self.command.motors[side], self.read_rad[side]))
    }

    fn answer(&mut self, reply: StepReply) {
        if self.process.as_mut().is_some_and(|process| reply.write(process).is_err()) {
            self.process = None;
        }
    }
}

fn run(
    listener: &UnixListener,
    mut world: World,
    count: usize,
    mut paces: Steps,
    (stop, steps): (&AtomicBool, &AtomicU32),
) -> Account {
    let body = |process| Body {
        process: Some(process),
        command: StepCommand::default(),
        read_rad: [0.0; 2],
        track: Vec::new(),
    };
    let mut bodies: Vec<Body> = gather(listener, count).into_iter().map(body).collect();
    let mut eyes = Eyes::new(1);
    let began = Instant::now();
    let mut due = began;
    for step in 1_u32.. {
        let ends = stop.load(Ordering::Acquire);
        for (robot, body) in bodies.iter_mut().enumerate() {
            body.listen();
            world.command(robot, body.wheels_radps());
        }
        world.step();
        steps.store(step, Ordering::Release);
        // Lost time is not made up, as in Webots.
        due = (due + paces.take()).max(Instant::now());
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        let time_s = f64::from(step) * STEP.as_secs();
        let places = world.places().to_vec();
        for (robot, body) in bodies.iter_mut().enumerate() {
            for (read_rad, turn) in body.read_rad.iter_mut().zip(world.wheel_turns(robot)) {
                *read_rad += 2.0 * (turn / 2.0).atan();
            }
            let pose = world.pose(robot);
            if step.is_multiple_of(STEPS_A_PLACE) {
                body.track.push((due, pose.at));
            }
            let near_m = if body.process.is_some() { eyes.near_m(pose, &places) } else { [0.0; RAYS] };
            let at = [pose.at.x, pose.at.y];
            body.answer(StepReply {
                ends,
                time_s,
                wheels_rad: body.read_rad,
                at,
                heading: pose.heading,
                near_m,
            });
        }
        if ends {
            break;
        }
    }
    let contacts = world.contacts();
    Account {
        contacts: contacts.count(),
        closest_m: contacts.closest_m(),
        colours: bodies.iter().map(|body| body.command.colour).collect(),
        places: world.places().to_vec(),
        rate: f64::from(steps.load(Ordering::Acquire)) * STEP.as_secs() / began.elapsed().as_secs_f64(),
        tracks: bodies.into_iter().map(|body| body.track).collect(),
    }
}

/// Accepts one connection per robot. Returns them in the order of the numbers in the robots' names.
fn gather(listener: &UnixListener, count: usize) -> Vec<UnixStream> {
    let mut sockets: Vec<(usize, UnixStream)> = (0..count)
        .map(|_| {
            let (mut socket, _) = listener.accept().expect("a driver comes");
            let name = read_name(&mut socket).expect("a driver says its name");
            let number = name.rsplit(' ').next().and_then(|text| text.parse().ok());
            (number.expect("names end with a number"), socket)
        })
        .collect();
    sockets.sort_by_key(|(number, _)| *number);
    sockets.into_iter().map(|(_, socket)| socket).collect()
}
