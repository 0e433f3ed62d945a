//! The simulated robots of the command `run`. They are replaced when the open show needs another stage or more robots
//! and nothing is being played.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use lightbots_control::{ControllerState, Operation};
use lightbots_link::BrokerUrl;
use lightbots_show::{Show, Stage, back_rows, robots_needed};
use lightbots_sim::{Conditions, FleetConfig};
use tokio::sync::watch;

use super::conductor::Handle;
use super::crowd::{Crowd, TOGETHER};
use crate::stop::Stop;
use crate::web::Shown;

/// Smallest number of robots that are simulated if the command line states no number.
const USUAL: usize = 30;
/// Largest number of robots that are simulated if the command line states no number.
const MOST: usize = 5_000;
/// Time without an edit of the show after which the robots are replaced by robots that fit the show.
const SETTLED: Duration = Duration::from_millis(500);

/// Which robots to simulate.
#[derive(Clone, Debug)]
pub struct Cast {
    /// The broker of the robots.
    pub broker: BrokerUrl,
    /// Number of robots; `None`: see [`Cast::robots`].
    pub count: Option<usize>,
    /// Seed of the simulation. Robots that are replaced by robots with the same seed keep their names.
    pub seed: u64,
    /// Simulated disturbances.
    pub conditions: Conditions,
    /// Number of robots that are simulated at present, for readers in other tasks.
    pub simulated: Arc<AtomicUsize>,
}

impl Cast {
    /// Returns the number of robots to simulate for a show: `count`, or as many as the show needs, between `USUAL` and
    /// `MOST`.
    pub fn robots(count: Option<usize>, show: &Show) -> usize {
        count.unwrap_or_else(|| robots_needed(show).clamp(USUAL, MOST))
    }

    /// Keeps simulated robots on the broker until `stop` is wanted. Replaces them when they do not fit the open show
    /// and nothing is being played. Returns at once if there are 0 robots to simulate.
    pub async fn run(self, handle: Handle, mut shown: watch::Receiver<Arc<Shown>>, stop: Stop) {
        while !stop.is_wanted() {
            let show = shown.borrow_and_update().show.clone();
            let robots = Self::robots(self.count, &show);
            self.simulated.store(robots, Ordering::Relaxed);
            if robots == 0 {
                return;
            }
            let (until, end) = stop.child();
            let time = (handle.clock(), handle.pace());
            handle.pace().simulates(robots, Some(self.broker.to_string()));
            let crowd = Crowd::start(&self.fleet(&show, robots), &self.broker, TOGETHER, time, &until);
            let names = crowd.ids();
            // On a thread of its own, because thousands of robots would keep a thread busy that other tasks need.
            let runtime = tokio::runtime::Handle::current();
            let going = tokio::task::spawn_blocking(move || runtime.block_on(crowd.run(until)));
            tokio::select! {
                () = stop.wait() => {}
                () = self.wait_for_misfit(&handle, &mut shown, &show.stage, robots) => {}
            }
            end.now();
            // A simulation that panicked has ended as well.
            let _ = going.await;
            handle.pace().simulates(0, None);
            for name in names {
                if stop.is_wanted() {
                    return;
                }
                // The controller refuses this for a robot that it does not know, which does no harm. It also refuses this
                // if a run or a stop has begun meanwhile: the robot then stays in the fleet as gone.
                let _ = handle.operate(Operation::Forget(name)).await;
            }
        }
    }

    fn fleet(&self, show: &Show, robots: usize) -> FleetConfig {
        let starts = match &show.starts {
            Some(starts) if starts.len() >= robots => starts[..robots].to_vec(),
            _ => back_rows(&show.stage, robots),
        };
        let conditions = self.conditions.clone();
        FleetConfig { stage: show.stage.clone(), starts, seed: self.seed, conditions }
    }

    /// Returns once the open show needs another stage or more robots, has not changed for `SETTLED`, and nothing is
    /// being played.
    async fn wait_for_misfit(
        &self,
        handle: &Handle,
        shown: &mut watch::Receiver<Arc<Shown>>,
        stage: &Stage,
        robots: usize,
    ) {
        loop {
            if shown.changed().await.is_err() {
                return std::future::pending().await;
            }
            while self.is_misfit(&shown.borrow_and_update().show, stage, robots) {
                tokio::time::sleep(SETTLED).await;
                let settled = !shown.has_changed().unwrap_or(false);
                let state = handle.look().await.map(|snapshot| snapshot.state);
                if settled && matches!(state, Some(ControllerState::Ready | ControllerState::Idle)) {
                    return;
                }
            }
        }
    }

    fn is_misfit(&self, show: &Show, stage: &Stage, robots: usize) -> bool {
        show.stage != *stage || Self::robots(self.count, show) > robots
    }
}
