use super::Assignment;
use lightbots_base::Vec2;

pub(super) fn assign(
    starts: &[Vec2],
    goals: &[Vec2],
    pinned: &[Option<usize>],
    slack: f64,
) -> Option<Assignment> {
    if goals.len() > starts.len() {
        return None;
    }
    let pin = |goal: usize| pinned.get(goal).copied().flatten();
    let mut taken = vec![false; starts.len()];
    for goal in 0..goals.len() {
        if let Some(start) = pin(goal) {
            if *taken.get(start)? {
                return None;
            }
            taken[start] = true;
        }
    }
    let square = |goal: usize, start: usize| {
        let allowed = pin(goal).map_or(!taken[start], |pin| pin == start);
        if allowed { (goals[goal] - starts[start]).length_squared() } else { 1e6 }
    };
    let mut all: Vec<f64> = (0..goals.len())
        .flat_map(|g| (0..starts.len()).map(move |s| (g, s)))
        .map(|(g, s)| square(g, s))
        .collect();
    all.sort_by(f64::total_cmp);
    let (mut low, mut high) = (0, all.len());
    while low < high {
        let mid = (low + high) / 2;
        let cost = |g, s| f64::from(u8::from(square(g, s) > all[mid]));
        if solve(goals.len(), starts.len(), &cost).0 < 0.5 { high = mid } else { low = mid + 1 }
    }
    let reach = all.get(low).copied().unwrap_or(0.0) * (1.0 + slack) * (1.0 + slack);
    let cost = |g, s| if square(g, s) > reach { 1e6 } else { square(g, s) };
    let start_of = solve(goals.len(), starts.len(), &cost).1;
    Some(Assignment { start_of, bottleneck_m: all.get(low).copied().unwrap_or(0.0).sqrt() })
}

fn solve(rows: usize, columns: usize, cost: &dyn Fn(usize, usize) -> f64) -> (f64, Vec<usize>) {
    let (mut u, mut v) = (vec![0.0; rows + 1], vec![0.0; columns + 1]);
    let mut p = vec![0usize; columns + 1];
    let mut way = vec![0usize; columns + 1];
    for i in 1..=rows {
        p[0] = i;
        let mut j0 = 0;
        let mut minv = vec![f64::INFINITY; columns + 1];
        let mut used = vec![false; columns + 1];
        loop {
            used[j0] = true;
            let (i0, mut delta, mut j1) = (p[j0], f64::INFINITY, 0);
            for j in 1..=columns {
                if !used[j] {
                    let cur = cost(i0 - 1, j - 1) - u[i0] - v[j];
                    if cur < minv[j] {
                        minv[j] = cur;
                        way[j] = j0;
                    }
                    if minv[j] < delta {
                        delta = minv[j];
                        j1 = j;
                    }
                }
            }
            for j in 0..=columns {
                if used[j] {
                    u[p[j]] += delta;
                    v[j] -= delta;
                } else {
                    minv[j] -= delta;
                }
            }
            j0 = j1;
            if p[j0] == 0 {
                break;
            }
        }
        while j0 != 0 {
            let j1 = way[j0];
            p[j0] = p[j1];
            j0 = j1;
        }
    }
    let mut start_of = vec![0; rows];
    let mut total = 0.0;
    for j in 1..=columns {
        if p[j] > 0 {
            start_of[p[j] - 1] = j - 1;
            total += cost(p[j] - 1, j - 1);
        }
    }
    (total, start_of)
}
