//! Chooses the pictures of an animation that robots show (key frames), so that robots have enough time to move between
//! them.

/// Price of a move between two pictures, in units of change (0 to 1). Because of it, few long moves are better than
/// many short moves, which look less calm.
const MOVE_PRICE: f64 = 0.01;
/// An animation is shown faithfully if robots show at least this share of its change.
const FAITHFUL: f64 = 0.8;
/// Factors of slow motion that are tried.
const SLOWDOWNS: [f64; 9] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0];

/// Key frames of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyMoments {
    /// Indices of the pictures that robots show, ascending. The first and the last picture are among them.
    pub moments: Vec<usize>,
    /// Factor by which the animation must be slowed down so that robots have time for the moves; 1 if it need not be
    /// slowed down.
    pub slowdown: f64,
    /// Change that robots show at `slowdown`, from 0 to 1: a share of the change that they would show with unlimited
    /// time.
    pub kept: f64,
    /// Smallest of the tried factors, at least `slowdown`, at which robots show 80 % of the change. `None` if no tried
    /// factor (up to 16) is enough.
    pub faithful_slowdown: Option<f64>,
}

/// A move between two pictures.
#[derive(Clone, Copy)]
struct Step {
    /// Change of the picture minus the cost of the move.
    gain: f64,
    /// Time that robots need divided by the time that they have.
    slowness: f64,
}

/// Chooses key frames. First it finds the least slowdown at which robots can get from the first to the last picture.
/// Then it looks at all sequences in which robots have enough time for each move at this slowdown. It takes the one
/// with the most change, less a small price for each move.
///
/// `times_s`: time at which each picture begins, ascending, seconds. `change` returns how much two pictures differ, 0
/// to 1. `cost_s` returns how long robots take from one picture to another, seconds. Both are called once for each pair
/// of pictures whose indices differ by at most `reach` (at least 1), the earlier picture first. `None` if there are no
/// pictures or the times do not ascend.
pub fn key_moments(
    times_s: &[f64],
    reach: usize,
    change: impl Fn(usize, usize) -> f64,
    mut cost_s: impl FnMut(usize, usize) -> f64,
) -> Option<KeyMoments> {
    let ascending = times_s.windows(2).all(|pair| pair[0] < pair[1]);
    if times_s.is_empty() || !ascending {
        return None;
    }
    let steps: Vec<Vec<Step>> = (0..times_s.len())
        .map(|to| {
            let from = to.saturating_sub(reach.max(1));
            let step = |from: usize| Step {
                gain: change(from, to) - MOVE_PRICE,
                slowness: cost_s(from, to) / (times_s[to] - times_s[from]),
            };
            (from..to).map(step).collect()
        })
        .collect();
    let slowdown = least_slowdown(&steps);
    let all = best(&steps, f64::INFINITY)?;
    let (value, moments) = best(&steps, slowdown)?;
    let share = |value: f64, moves: usize| {
        let change = |value: f64, moves: usize| value + MOVE_PRICE * moves as f64;
        let whole = change(all.0, all.1.len() - 1);
        if whole > 0.0 { (change(value, moves) / whole).clamp(0.0, 1.0) } else { 1.0 }
    };
    let kept = share(value, moments.len() - 1);
    let faithful = |factor: &f64| {
        best(&steps, *factor).is_some_and(|(value, moments)| share(value, moments.len() - 1) >= FAITHFUL)
    };
    let faithful_slowdown = SLOWDOWNS.into_iter().filter(|factor| *factor >= slowdown).find(faithful);
    Some(KeyMoments { moments, slowdown, kept, faithful_slowdown })
}

/// Returns the least slowdown, at least 1, at which a chain of moves leads from the first picture to the last.
fn least_slowdown(steps: &[Vec<Step>]) -> f64 {
    let mut least: Vec<f64> = Vec::with_capacity(steps.len());
    for (to, moves) in steps.iter().enumerate() {
        let first = to - moves.len();
        let through = moves.iter().enumerate().map(|(n, step)| step.slowness.max(least[first + n]));
        least.push(through.reduce(f64::min).unwrap_or(1.0));
    }
    least.last().map_or(1.0, |slowness| slowness.max(1.0))
}

/// Finds the chain of moves from the first picture to the last with the largest sum of gains. Only moves with a
/// slowness of at most `slowdown` are allowed. Returns the sum and the indices of the pictures in the chain. `None` if
/// there is no chain.
fn best(steps: &[Vec<Step>], slowdown: f64) -> Option<(f64, Vec<usize>)> {
    let mut sums: Vec<Option<(f64, usize)>> = Vec::with_capacity(steps.len());
    for (to, moves) in steps.iter().enumerate() {
        let first = to - moves.len();
        let start = (to == 0).then_some((0.0, 0));
        let through = moves.iter().enumerate().filter(|(_, step)| step.slowness <= slowdown);
        let through = through.filter_map(|(n, step)| {
            sums.get(first + n).copied().flatten().map(|(sum, _)| (sum + step.gain, first + n))
        });
        let best = through.max_by(|a, b| a.0.total_cmp(&b.0));
        sums.push(start.or(best));
    }
    let sum = sums.last().copied().flatten()?.0;
    let mut moments = vec![steps.len() - 1];
    while let Some(at) = moments.last().copied().filter(|at| *at > 0) {
        moments.push(sums.get(at).copied().flatten()?.1);
    }
    moments.reverse();
    Some((sum, moments))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures of a thing, one second apart. It moves by 1 from picture to picture, then stands. Robots move at
    /// `speed` per second and need 0.5 s to start and stop.
    fn moved(speed: f64) -> Option<KeyMoments> {
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        let place = |n: usize| n.min(4) as f64;
        let away = |a: usize, b: usize| (place(a) - place(b)).abs();
        key_moments(&times, 8, |a, b| (away(a, b) * 0.3).min(1.0), |a, b| 0.5 + away(a, b) / speed)
    }

    #[test]
    fn key_frames_have_time_for_the_moves() {
        let fast = moved(4.0).expect("it can be played");
        assert_eq!((fast.moments.as_slice(), fast.slowdown), ([0, 3, 8].as_slice(), 1.0));
        let slow = moved(1.1).expect("it can be played");
        assert!(slow.slowdown == 1.0 && slow.moments.len() < 6, "{slow:?}");
        let steps = slow.moments.windows(2).map(|pair| (pair[0], pair[1]));
        for (from, to) in steps {
            let way = (to.min(4) - from.min(4)) as f64;
            assert!(0.5 + way / 1.1 <= (to - from) as f64, "{from} {to}");
        }
    }

    #[test]
    fn animations_that_are_too_fast_are_slowed_down() {
        let slow = moved(0.1).expect("it can be played slowly");
        assert!(slow.slowdown > 4.0 && slow.slowdown < 6.0, "{slow:?}");
        assert!(slow.faithful_slowdown.is_some_and(|factor| factor >= slow.slowdown));
        assert_eq!((slow.moments.first(), slow.moments.last()), (Some(&0), Some(&8)));
    }

    #[test]
    fn the_plan_is_the_best_of_all() {
        let times = [0.0, 0.4, 1.0, 1.7, 2.1, 3.0, 3.2];
        let mut state = 3;
        let mut unit = || lightbots_base::random::split_mix(&mut state) as f64 / u64::MAX as f64;
        for _ in 0..20 {
            let table: Vec<[f64; 2]> = (0..49).map(|_| [unit(), 2.0 * unit()]).collect();
            let at = |a: usize, b: usize| table[a * 7 + b];
            let plan = key_moments(&times, 6, |a, b| at(a, b)[0], |a, b| at(a, b)[1]).expect("it ends");
            let value = |moments: &[usize]| {
                moments.windows(2).map(|pair| at(pair[0], pair[1])[0] - MOVE_PRICE).sum::<f64>()
            };
            let all = (0..32usize).map(|chosen| {
                let inner = (1..6).filter(|n| chosen >> (n - 1) & 1 == 1);
                std::iter::once(0).chain(inner).chain([6]).collect::<Vec<usize>>()
            });
            let fits = |moments: &Vec<usize>| {
                let slow = |pair: &[usize]| at(pair[0], pair[1])[1] / (times[pair[1]] - times[pair[0]]);
                moments.windows(2).all(|pair| slow(pair) <= plan.slowdown)
            };
            let best = all.filter(fits).map(|moments| value(&moments)).fold(f64::MIN, f64::max);
            assert!((value(&plan.moments) - best).abs() < 1e-9);
        }
    }

    #[test]
    fn one_picture_is_a_plan_and_wrong_times_are_none() {
        let plan = |times: &[f64]| key_moments(times, 5, |_, _| 1.0, |_, _| 1.0);
        assert_eq!(plan(&[2.0]).map(|plan| (plan.moments, plan.kept)), Some((vec![0], 1.0)));
        assert_eq!((plan(&[]), plan(&[1.0, 1.0]), plan(&[0.0, f64::NAN])), (None, None, None));
    }
}
