//! Finds beats of music.

use lightbots_api::{BeatsAnswer, MakeRemark};
use lightbots_music::{NoBeats, Sound, find_beats, steady};

/// Finds the beats of music. `samples` are those of one channel, where 1 is full scale, `rate_hz` of them per second. If
/// the tempo is steady, the answer has the time of the first beat, else the times of all beats.
pub fn beats_answer(samples: &[f32], rate_hz: f64) -> BeatsAnswer {
    match Sound::new(samples, rate_hz).and_then(|sound| find_beats(&sound)) {
        Ok(found) => {
            let even = steady(&found.times_s);
            BeatsAnswer {
                bpm: even.map_or(found.bpm, |even| even.bpm),
                offset_s: even.map(|even| even.offset_s),
                times_s: if even.is_some() { Vec::new() } else { found.times_s },
                error: None,
            }
        }
        Err(error) => BeatsAnswer { error: Some(remark(error)), ..BeatsAnswer::default() },
    }
}

fn remark(error: NoBeats) -> MakeRemark {
    let code = match error {
        NoBeats::Short(_) => "music-short",
        NoBeats::Long(_) => "music-long",
        NoBeats::Rate(_) => "music-rate",
        NoBeats::Silent => "music-silent",
    };
    crate::make::remark(code, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A click of 5 ms at each moment.
    fn clicks(moments_s: impl Iterator<Item = f64>) -> Vec<f32> {
        let mut samples = vec![0.0; 22_050 * 30];
        for at_s in moments_s {
            let first = (at_s * 22_050.0) as usize;
            for (i, sample) in samples[first..].iter_mut().take(110).enumerate() {
                *sample = if i % 8 < 4 { 0.8 } else { -0.8 };
            }
        }
        samples
    }

    #[test]
    fn clicks_at_one_tempo_are_a_grid() {
        let answer = beats_answer(&clicks((0..58).map(|i| 0.25 + f64::from(i) * 0.5)), 22_050.0);
        assert!((answer.bpm - 120.0).abs() < 0.1 && answer.times_s.is_empty(), "{answer:?}");
        assert!((answer.offset_s.unwrap() - 0.25).abs() < 0.02, "{answer:?}");
    }

    #[test]
    fn clicks_that_grow_faster_keep_their_moments() {
        let moments = |i: u32| 0.3 + 0.6 * f64::from(i) - 0.0012 * f64::from(i * i);
        let answer = beats_answer(&clicks((0..50).map(moments)), 22_050.0);
        assert_eq!(answer.offset_s, None);
        assert!(answer.times_s.len() >= 48, "{answer:?}");
        let near = |time: &f64| (0..50).any(|i| (moments(i) - time).abs() < 0.03);
        assert!(answer.times_s.iter().all(near), "{answer:?}");
    }

    #[test]
    fn what_has_no_beats_says_why() {
        let code = |samples: &[f32], rate_hz| beats_answer(samples, rate_hz).error.unwrap().code;
        assert_eq!(code(&[], 44_100.0), "music-short");
        assert_eq!(code(&[0.0; 80_000], 8_000.0), "music-silent");
        assert_eq!(code(&[f32::NAN; 80_000], 8_000.0), "music-silent");
        assert_eq!(code(&vec![0.0; 8_000 * 3_601], 8_000.0), "music-long");
        assert_eq!(code(&[0.0; 80_000], 0.0), "music-rate");
        assert_eq!(code(&[0.0; 80_000], f64::NAN), "music-rate");
    }
}
