//! What a solver leaves that finds no splines without contacts.

use std::collections::BTreeSet;

use lightbots_base::Vec2;

use crate::Meeting;
use crate::explain::RowOutcome;
use crate::optimise::contacts::{Contact, Other};

/// The contacts that are left of the detection that found the fewest.
#[derive(Default)]
pub(crate) struct LeftOver {
    /// Pairs of robots that are too close, each once, and their places.
    pub meetings: Vec<Meeting>,
    /// Number of pairs that are too close: two robots, or a robot and a wall. 0 if the proof rejects the splines.
    /// `None` if no regular detection found a contact, for example because the work ended before.
    contacts: Option<usize>,
}

impl LeftOver {
    /// What is left of splines that the proof rejects.
    pub const BY_PROOF: Self = Self { meetings: Vec::new(), contacts: Some(0) };

    /// Of contacts in which robots are too close. `place` returns the place of a contact with the robot of this index.
    pub fn of<'a>(
        contacts: impl Iterator<Item = &'a Contact>,
        place: impl Fn(&Contact, usize) -> Vec2,
    ) -> Self {
        let mut walls = BTreeSet::new();
        let mut meetings = Vec::new();
        for contact in contacts {
            match contact.b {
                Other::Robot(b) => {
                    meetings.push(Meeting { pair: (contact.a, b), place: place(contact, b) });
                }
                Other::Wall(wall) => {
                    walls.insert((contact.a, wall));
                }
            }
        }
        meetings.sort_by_key(|meeting| meeting.pair);
        meetings.dedup_by_key(|meeting| meeting.pair);
        Self { contacts: Some(meetings.len() + walls.len()), meetings }
    }

    /// The outcome of a row of the schedule that leaves this.
    pub fn outcome(&self) -> RowOutcome {
        self.contacts.map_or(RowOutcome::Unfinished, |contacts| RowOutcome::Rejected { contacts })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::instance::Instance;
    use crate::optimise::contacts::Clearances;
    use crate::optimise::relaxation::{Effort, relax};
    use crate::spline::set::SplineSet;
    use lightbots_base::Limits;
    use lightbots_show::Obstacle;

    /// The outcome for a robot on a path through a wall, after one sweep with this work.
    fn through_a_wall(mut work: usize) -> RowOutcome {
        let (start, goal) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
        let problem = TransitionProblem {
            starts: vec![start],
            goals: vec![goal],
            obstacles: vec![Obstacle::Disc { at: Vec2::new(0.0, 0.01), radius_m: 0.1 }],
            ..TransitionProblem::on_floor(Vec2::new(0.8, 0.8), Limits::ELISA_3)
        };
        let instance = Instance::new(&problem, &[Some(0)]).expect("start and goal are free");
        let splines = SplineSet::new(&instance, 12, 0.3, |_, step| start.lerp(goal, step as f64 / 12.0));
        let clearances = Clearances { robots_m: 0.06, walls_m: 0.006, edge_m: 0.0, slack_m: 0.002 };
        let effort = Effort { sweeps: 1, stretch: 2.0, hurry: false, clearances };
        relax(&instance, splines, effort, &mut work).map_or_else(|left| left.outcome(), |_| panic!("solved"))
    }

    #[test]
    fn contacts_with_walls_count_each_pair_once() {
        assert_eq!(through_a_wall(1_000), RowOutcome::Rejected { contacts: 1 });
    }

    #[test]
    fn without_work_nothing_is_known_of_contacts() {
        assert_eq!(through_a_wall(0), RowOutcome::Unfinished);
    }
}
