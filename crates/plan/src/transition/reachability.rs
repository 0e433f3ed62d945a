//! Regions of the floor between which no robot can drive. Assigns robots to pixels within each region, or says which
//! robots or pixels are cut off.

use lightbots_base::Vec2;

use crate::assignment::Choice;
use crate::cancel::Cancel;
use crate::roads::regions::{Gap, Regions, Thing, enough_m};
use crate::{Infeasible, TransitionProblem};

/// Most no-go areas that a message names.
const MOST_NAMED: usize = 4;
/// Least width of a gap that a message names, metres; a narrower gap counts as none.
const LEAST_GAP_M: f64 = 0.001;

/// How walls restrict a transition.
pub(super) enum Walls {
    /// No restriction: all robots can drive to all goals, the regions of some places are unknown, or no assignment
    /// within the regions was found.
    Open,
    /// Each robot must stay in its region. `[goal]`: index of the start assigned to that goal.
    Apart(Vec<Option<usize>>),
    /// A robot or a pixel is cut off.
    Closed(Infeasible),
}

/// Finds how walls restrict a transition, by the regions into which they divide its floor.
pub(super) fn look(problem: &TransitionProblem, cancel: Cancel<'_>) -> Walls {
    let Some(regions) = Regions::new(problem, cancel).filter(|regions| regions.parts > 1) else {
        return Walls::Open;
    };
    let parts =
        |places: &[Vec2]| places.iter().map(|&place| regions.part(place)).collect::<Option<Vec<u32>>>();
    let (Some(starts), Some(goals)) = (parts(&problem.starts), parts(&problem.goals)) else {
        return Walls::Open;
    };
    if goals.iter().chain(&starts).all(|&part| goals.first() == Some(&part)) {
        return Walls::Open;
    }
    let partition = Partition { problem, regions, starts, goals };
    match partition.closed() {
        Some(infeasible) => Walls::Closed(infeasible),
        None => partition.sent(cancel).map_or(Walls::Open, Walls::Apart),
    }
}

/// A transition and the regions of its starts and goals.
struct Partition<'a> {
    problem: &'a TransitionProblem,
    regions: Regions,
    /// `[start]`: number of its region.
    starts: Vec<u32>,
    /// `[goal]`: number of its region.
    goals: Vec<u32>,
}

impl Partition<'_> {
    fn pin(&self, goal: usize) -> Option<usize> {
        self.problem.pinned.get(goal).copied().flatten()
    }

    /// Returns the message about robots or pixels that are cut off; `None` if there are none.
    fn closed(&self) -> Option<Infeasible> {
        let pinned = (0..self.goals.len()).filter_map(|goal| self.pin(goal).map(|start| (goal, start)));
        if let Some((goal, start)) =
            pinned.clone().find(|&(goal, start)| self.goals[goal] != self.starts[start])
        {
            let (from, to) = (self.problem.starts[start], self.problem.goals[goal]);
            let subject = format!("the robot at {} is kept from the pixel at {}", place(from), place(to));
            return Some(self.infeasible(
                subject,
                self.smaller(self.starts[start], self.goals[goal]),
                vec![goal],
                vec![start],
            ));
        }
        let count = |of: &[u32], part: u32| of.iter().filter(|&&other| other == part).count();
        let mut parts: Vec<u32> = self.goals.clone();
        parts.sort_unstable();
        parts.dedup();
        let lacking =
            parts.iter().copied().find(|&part| count(&self.goals, part) > count(&self.starts, part))?;
        // The message is about pixels without robots, or about robots that are walled in: about whichever are fewer.
        let walled: Vec<usize> =
            (0..self.starts.len()).filter(|&start| self.starts[start] != lacking).collect();
        let goals: Vec<usize> = (0..self.goals.len()).filter(|&goal| self.goals[goal] == lacking).collect();
        if goals.len() <= walled.len() {
            return Some(self.pixels_cut_off(goals, count(&self.starts, lacking)));
        }
        let at = place(self.problem.starts[walled[0]]);
        let subject = match walled.len() {
            1 => format!("the robot at {at} is walled in"),
            more => format!("{more} robots such as the one at {at} are walled in"),
        };
        let part = self.starts[walled[0]];
        Some(self.infeasible(subject, part, Vec::new(), walled))
    }

    /// Returns the message about a region with more pixels than robots.
    fn pixels_cut_off(&self, goals: Vec<usize>, robots: usize) -> Infeasible {
        let at = place(self.problem.goals[goals[0]]);
        let what = match goals.len() {
            1 => format!("the pixel at {at} is cut off"),
            many => format!("{many} pixels such as the one at {at} are cut off"),
        };
        let subject = match robots {
            0 => format!("{what} from all robots"),
            1 => format!("{what} with only one robot"),
            few => format!("{what} with only {few} robots"),
        };
        self.infeasible(subject, self.goals[goals[0]], goals, Vec::new())
    }

    /// Returns the region, of regions `a` and `b`, that has fewer robots and pixels.
    fn smaller(&self, a: u32, b: u32) -> u32 {
        let count = |part: u32| self.starts.iter().chain(&self.goals).filter(|&&other| other == part).count();
        if count(a) < count(b) { a } else { b }
    }

    /// Returns the message about robots or pixels that are cut off in region `part`: `subject` names them. The message
    /// names the things around the region, and a gap that would help.
    fn infeasible(&self, subject: String, part: u32, goals: Vec<usize>, starts: Vec<usize>) -> Infeasible {
        let things = named(&self.regions.around(part));
        let remedy = match self.regions.way_out(part) {
            Some(gap) if gap.wide_m >= LEAST_GAP_M => self.wider(&gap),
            _ => {
                let enough = enough_m(self.problem, (Thing::Obstacle(0), Thing::Obstacle(1)));
                format!("leave a gap of {:.0} mm", whole_mm(enough))
            }
        };
        Infeasible { goals, starts, message: format!("{subject} by {things}; {remedy}") }
    }

    fn wider(&self, gap: &Gap) -> String {
        let (from, to) = gap.ends;
        let between = match gap.between {
            (thing, Thing::Edge) => format!("{} and the floor's edge", named(&[thing])),
            (one, other) => named(&[one, other]),
        };
        format!(
            "the gap between {between} near {} is {:.1} mm wide, {:.0} mm do",
            place(from.lerp(to, 0.5)),
            gap.wide_m * 1e3,
            whole_mm(enough_m(self.problem, gap.between))
        )
    }

    /// Assigns robots to goals within each region. Returns `[goal]`: index of its start; `None` if there is no
    /// assignment.
    fn sent(&self, cancel: Cancel<'_>) -> Option<Vec<Option<usize>>> {
        let mut start_of = vec![None; self.goals.len()];
        for part in 0..self.regions.parts as u32 {
            let goals: Vec<usize> = (0..self.goals.len()).filter(|&goal| self.goals[goal] == part).collect();
            let starts: Vec<usize> =
                (0..self.starts.len()).filter(|&start| self.starts[start] == part).collect();
            if goals.is_empty() {
                continue;
            }
            let rank = |start: usize| starts.iter().position(|&other| other == start);
            let pinned: Vec<Option<usize>> =
                goals.iter().map(|&goal| self.pin(goal).and_then(rank)).collect();
            let at =
                |places: &[Vec2], of: &[usize]| of.iter().map(|&index| places[index]).collect::<Vec<_>>();
            let choice = Choice::unless(
                cancel,
                &at(&self.problem.starts, &starts),
                &at(&self.problem.goals, &goals),
                &pinned,
            )?;
            for (&goal, start) in goals.iter().zip(choice.least_squares().solve(0.0)?) {
                start_of[goal] = Some(starts[start]);
            }
        }
        Some(start_of)
    }
}

/// Converts metres to whole millimetres, rounded up.
fn whole_mm(metres: f64) -> f64 {
    (metres * 1e3 - 1e-6).ceil()
}

fn place(at: Vec2) -> String {
    format!("({:.2}, {:.2}) m", at.x + 0.0, at.y + 0.0)
}

/// Names things in a message. No-go areas are numbered from 1, in the order of the show. The floor's edge is named only
/// if there is no other thing.
fn named(things: &[Thing]) -> String {
    let numbers: Vec<String> = things
        .iter()
        .filter_map(|thing| match thing {
            Thing::Obstacle(index) => Some((index + 1).to_string()),
            _ => None,
        })
        .collect();
    let standing = things.iter().filter(|thing| matches!(thing, Thing::Standing(_))).count();
    let mut parts = Vec::new();
    match numbers.len() {
        0 => {}
        1 => parts.push(format!("area {}", numbers[0])),
        many if many > MOST_NAMED => {
            parts.push(format!("areas {} and {} more", numbers[..MOST_NAMED].join(", "), many - MOST_NAMED));
        }
        _ => parts.push(format!("areas {}", list(&numbers))),
    }
    match standing {
        0 => {}
        1 => parts.push("a robot that stands".into()),
        many => parts.push(format!("{many} robots that stand")),
    }
    if parts.is_empty() { "the floor's edge".into() } else { list(&parts) }
}

fn list(parts: &[String]) -> String {
    match parts {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        _ => parts.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transition;
    use lightbots_base::Limits;
    use lightbots_show::Obstacle;

    /// Four walls around the middle, 0.4 m apart, with a gap in the upper one.
    fn boxed(gap_m: f64) -> Vec<Obstacle> {
        let wall = |x0, y0, x1, y1| Obstacle::Rect { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) };
        vec![
            wall(-0.24, -0.24, 0.24, -0.2),
            wall(-0.24, -0.2, -0.2, 0.2),
            wall(0.2, -0.2, 0.24, 0.2),
            wall(-0.24, 0.2, -gap_m / 2.0, 0.24),
            wall(gap_m / 2.0, 0.2, 0.24, 0.24),
        ]
    }

    fn problem(starts: &[(f64, f64)], goals: &[(f64, f64)], obstacles: Vec<Obstacle>) -> TransitionProblem {
        let places = |of: &[(f64, f64)]| of.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        let floor = TransitionProblem::on_floor(Vec2::new(1.5, 1.5), Limits::ELISA_3);
        TransitionProblem { starts: places(starts), goals: places(goals), obstacles, ..floor }
    }

    #[track_caller]
    fn message(problem: &TransitionProblem) -> String {
        transition(problem).unwrap_err().message
    }

    /// Two places outside the box, stage metres.
    const OUTSIDE: [(f64, f64); 2] = [(-0.5, 1.0), (0.5, 1.0)];

    #[test]
    fn a_pixel_in_a_box_is_named_with_its_walls_and_the_gap_that_would_do() {
        let infeasible = transition(&problem(&OUTSIDE, &[(0.6, 0.8), (0.0, 0.1)], boxed(0.058))).unwrap_err();
        assert_eq!(infeasible.goals, [1]);
        assert_eq!(
            infeasible.message,
            "the pixel at (0.00, 0.10) m is cut off from all robots by areas 1, 2, 3, 4 and 1 more; \
             the gap between areas 4 and 5 near (0.00, 0.22) m is 58.0 mm wide, 61 mm do"
        );
    }

    #[test]
    fn a_robot_in_a_box_is_named() {
        let message = message(&problem(&[OUTSIDE[0], (0.0, 0.0)], &OUTSIDE, boxed(0.0)));
        assert_eq!(
            message,
            "the robot at (0.00, 0.00) m is walled in by areas 1, 2, 3, 4 and 1 more; leave a gap of 61 mm"
        );
    }

    #[test]
    fn a_wall_almost_to_the_edge_cuts_the_floor_in_two() {
        let wall = |right| vec![Obstacle::Rect { min: Vec2::new(-1.5, 0.0), max: Vec2::new(right, 0.1) }];
        let goals = [(-0.5, -0.5), (0.5, -0.5)];
        assert_eq!(
            message(&problem(&OUTSIDE, &goals, wall(1.45))),
            "2 pixels such as the one at (-0.50, -0.50) m are cut off from all robots by area 1; \
             the gap between area 1 and the floor's edge near (1.48, 0.05) m is 50.0 mm wide, 58 mm do"
        );
        assert!(transition(&problem(&OUTSIDE, &goals, wall(1.44))).is_ok());
    }

    #[test]
    fn a_robot_pinned_to_a_pixel_behind_a_wall_is_named() {
        let mut problem = problem(&[OUTSIDE[0], (0.0, 0.0)], &[(0.0, 0.1), OUTSIDE[1]], boxed(0.02));
        assert!(transition(&problem).is_ok());
        problem.pinned = vec![Some(0)];
        let infeasible = transition(&problem).unwrap_err();
        assert!(
            infeasible.message.starts_with(
                "the robot at (-0.50, 1.00) m is kept from the pixel at (0.00, 0.10) m by areas"
            )
        );
        assert_eq!((infeasible.goals, infeasible.starts), (vec![0], vec![0]));
    }

    #[test]
    fn robots_are_sent_only_where_ways_lead() {
        // Straight lines would send the robot in the box to the pixel below it, and another robot into the box.
        let starts = [(-0.5, 1.3), (0.5, 1.3), (0.0, 0.0)];
        let goals = [(0.0, -0.9), (0.0, 0.1), (0.5, 0.9)];
        let plan = transition(&problem(&starts, &goals, boxed(0.0))).unwrap();
        assert_eq!(plan.goal_of, [Some(0), Some(2), Some(1)]);
    }

    #[test]
    fn a_walled_in_robot_is_the_spare_one() {
        let starts = [(-0.5, 1.3), (0.5, 1.3), (0.0, 0.0)];
        let plan = transition(&problem(&starts, &[(0.0, -0.9), (0.3, 0.0)], boxed(0.0))).unwrap();
        assert_eq!(plan.goal_of[2], None);
    }

    #[test]
    fn gaps_are_measured_between_discs_too() {
        let row = |apart_m: f64| {
            let disc =
                |nth: i32| Obstacle::Disc { at: Vec2::new(f64::from(nth) * apart_m, 0.0), radius_m: 0.07 };
            (-8..=8).map(disc).collect::<Vec<_>>()
        };
        let goals = [(-0.5, -0.5), (0.5, -0.5)];
        assert!(message(&problem(&OUTSIDE, &goals, row(0.199))).contains("is 59.0 mm wide, 61 mm do"));
        assert!(transition(&problem(&OUTSIDE, &goals, row(0.21))).is_ok());
    }
}
