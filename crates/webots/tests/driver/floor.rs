//! The floor that the drivers' processes stand on: our simulated world behind the stand-in's socket, at real pace.

use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use Controller::socket::{Seen, Told, read_name};
use lightbots_base::{Pose, Vec2};
use lightbots_show::Stage;
use lightbots_sim::{STEP, World};

use crate::eyes::Eyes;

/// What happened on a floor.
#[derive(Debug)]
pub struct Account {
    /// Pairs of robots that touched.
    pub contacts: u64,
    /// Least distance between two centres, metres.
    pub closest_m: Option<f64>,
    /// The last colour of each robot's light.
    pub colours: Vec<u32>,
    /// Where they stood at the end.
    pub places: Vec<Vec2>,
    /// Where they were, each a track: `[robot][tenth of a second]`, when and where.
    pub tracks: Vec<Vec<(Instant, Vec2)>>,
    /// How far it fell behind real time at most, seconds.
    pub behind_s: f64,
}

/// Steps between two places of a track.
const STEPS_A_PLACE: u32 = 6;

/// A floor with a thread that steps it.
pub struct Floor {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<Account>,
}

impl Floor {
    /// Listens at `address` and begins once so many processes have come; robot `LightBot n` stands at start n−1. Where
    /// there are more starts, a robot without power stands there.
    pub fn open(address: &Path, stage: &Stage, starts: &[Vec2], processes: usize, seed: u64) -> Self {
        let listener = UnixListener::bind(address).expect("the socket's path is free");
        let poses: Vec<Pose> = starts.iter().map(|at| Pose::new(*at, std::f64::consts::FRAC_PI_2)).collect();
        let world = World::new(stage, &poses, 0.0, seed);
        let stop = Arc::new(AtomicBool::new(false));
        let asked = stop.clone();
        let thread = std::thread::spawn(move || run(&listener, world, processes, &asked));
        Self { stop, thread }
    }

    /// Ends the simulation as Webots does, and tells what happened.
    pub fn close(self) -> Account {
        self.stop.store(true, Ordering::Release);
        self.thread.join().expect("the floor ran to its end")
    }
}

fn run(listener: &UnixListener, mut world: World, count: usize, stop: &AtomicBool) -> Account {
    let mut sockets = gather(listener, count);
    let mut turned = vec![[0.0; 2]; count];
    let mut colours = vec![0; count];
    let mut tracks: Vec<Vec<(Instant, Vec2)>> = vec![Vec::new(); count];
    let mut eyes = Eyes::new(1);
    let mut behind_s = 0.0_f64;
    let began = Instant::now();
    for step in 1_u32.. {
        let ends = stop.load(Ordering::Acquire);
        for (robot, socket) in sockets.iter_mut().enumerate() {
            let told = Told::read(socket).expect("a driver's process ended");
            world.tell(robot, told.wheels_radps);
            colours[robot] = told.colour;
        }
        world.step();
        let time_s = f64::from(step) * STEP.as_secs();
        let places = world.places().to_vec();
        let due = Duration::from_secs_f64(time_s);
        let moment = Instant::now().max(began + due);
        for (robot, socket) in sockets.iter_mut().enumerate() {
            let turns = world.wheel_turns(robot);
            turned[robot] = [turned[robot][0] + turns[0], turned[robot][1] + turns[1]];
            let pose = world.pose(robot);
            if step.is_multiple_of(STEPS_A_PLACE) {
                tracks[robot].push((moment, pose.at));
            }
            let seen = Seen {
                ends,
                time_s,
                wheels_rad: turned[robot],
                at: [pose.at.x, pose.at.y],
                heading: pose.heading,
                near_m: eyes.near_m(pose, &places),
            };
            seen.write(socket).expect("a driver's process ended");
        }
        if ends {
            break;
        }
        behind_s = behind_s.max(began.elapsed().as_secs_f64() - time_s);
        std::thread::sleep(due.saturating_sub(began.elapsed()));
    }
    let contacts = world.contacts();
    Account {
        contacts: contacts.count(),
        closest_m: contacts.closest_m(),
        colours,
        places: world.places().to_vec(),
        tracks,
        behind_s,
    }
}

/// One socket a robot, in the order of the numbers in their names.
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
