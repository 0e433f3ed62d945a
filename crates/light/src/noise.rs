//! Repeatable randomness: hashes and value noise.

use lightbots_base::random::split_mix;

/// A pseudorandom number from 0 (included) to 1 (excluded): a hash of the seed and two words.
pub(crate) fn unit(seed: u64, first: u64, second: u64) -> f64 {
    share(mixed(mixed(mixed(0, seed), first), second))
}

fn mixed(state: u64, word: u64) -> u64 {
    let mut state = state ^ word;
    split_mix(&mut state)
}

fn share(hash: u64) -> f64 {
    // An `f64` holds whole numbers of 53 bits exactly.
    (hash >> 11) as f64 / (1u64 << 53) as f64
}

/// The number of the cycle in which a phase is, as a word for [`unit()`]: the phase rounded down to a whole number.
pub(crate) fn cycle(phase: f64) -> u64 {
    libm::floor(phase) as i64 as u64
}

/// Value noise, 0 to 1: random values where all coordinates are whole numbers, interpolated in between with a continuous
/// first derivative.
fn value(seed: u64, at: [f64; 3]) -> f64 {
    let cell = at.map(libm::floor);
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let share = at[axis] - cell[axis];
        share * share * (3.0 - 2.0 * share)
    });
    let corner = |dx: u64, dy: u64, dz: u64| {
        let [cx, cy, cz] = cell.map(|floor| floor as i64 as u64);
        let plane = mixed(mixed(0, seed), cx.wrapping_add(dx));
        share(mixed(mixed(plane, cy.wrapping_add(dy)), cz.wrapping_add(dz)))
    };
    let along_x = |dy, dz| mix(corner(0, dy, dz), corner(1, dy, dz), x);
    let along_y = |dz| mix(along_x(0, dz), along_x(1, dz), y);
    mix(along_y(0), along_y(1), z)
}

fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

/// The weighted mean of `count` octaves of value noise, 0 to 1. Each octave has twice the frequency and half the weight
/// of the previous octave.
pub(crate) fn octaves(seed: u64, at: [f64; 3], count: u32) -> f64 {
    let (mut sum, mut weights, mut scale) = (0.0, 0.0, 1.0);
    for octave in 0..u64::from(count.max(1)) {
        sum += value(seed.wrapping_add(octave), at.map(|axis| axis * scale)) / scale;
        weights += 1.0 / scale;
        scale *= 2.0;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_spread_evenly() {
        let mean: f64 = (0..10_000).map(|robot| unit(7, robot, 0)).sum::<f64>() / 10_000.0;
        // The standard deviation of the mean is 0.0029.
        assert!((mean - 0.5).abs() < 0.012, "{mean}");
    }

    #[test]
    fn noise_is_continuous_across_cells_and_below_zero() {
        for step in -400..400 {
            let x = f64::from(step) / 100.0;
            let change = octaves(3, [x, -x, 0.3], 3) - octaves(3, [x + 1e-6, -x - 1e-6, 0.3], 3);
            assert!(change.abs() < 1e-4, "{x}: {change}");
        }
    }
}
