//! Repeatable numbers that look random: the same on every machine, from a state that the caller keeps.

/// The next number of the generator SplitMix64 (Steele, Lea and Flood 2014). Its numbers pass statistical tests, even
/// if seeds differ in one bit only.
#[inline]
pub fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut mixed = *state;
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// Advances a linear congruential generator modulo 2^64 (Knuth's MMIX) and returns its state. Only the high bits look
/// random. Meant for tests.
#[inline]
pub fn congruential(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_numbers_are_those_of_the_reference() {
        // The reference implementation's output for seed 1234567.
        let mut state = 1_234_567;
        assert_eq!(split_mix(&mut state), 6_457_827_717_110_365_317);
        assert_eq!(split_mix(&mut state), 3_203_168_211_198_807_973);
        let mut state = 0;
        assert_eq!(congruential(&mut state), 1_442_695_040_888_963_407);
    }
}
