//! The position at which music is played, and how it follows the show.

/// Decoded music.
#[derive(Debug, Default)]
pub(super) struct LoudMusic {
    /// Interleaved samples: frame after frame, each with one sample for each channel; 1 is full scale.
    pub samples: Vec<f32>,
    pub channels: usize,
    pub rate_hz: f64,
}

/// Error of the position below which sound is left alone, seconds.
const NEAR_S: f64 = 0.003;
/// Error of the position above which sound jumps to the right place, seconds.
const FAR_S: f64 = 0.03;
/// Largest change of the playing speed, as a share of the speed. Such a change of pitch is too small to be heard.
const RATE_MAX: f64 = 0.005;
/// The change of speed is the position's error divided by this time, seconds, up to `RATE_MAX`.
const GONE_IN_S: f64 = 2.0;

impl LoudMusic {
    /// Returns the sample of a channel at a position, interpolated between two frames. Before the start and after the
    /// end of the music, the sample is 0, silence. A channel that the music lacks has the samples of its last channel.
    fn at(&self, position_s: f64, channel: usize) -> f32 {
        let frame = position_s * self.rate_hz;
        if frame < 0.0 {
            return 0.0;
        }
        let (first, share) = (frame as usize, frame.fract() as f32);
        let channel = channel.min(self.channels.saturating_sub(1));
        let sample = |frame: usize| self.samples.get(frame * self.channels + channel).copied().unwrap_or(0.0);
        sample(first) * (1.0 - share) + sample(first + 1) * share
    }
}

/// The position in the music that is played.
#[derive(Debug, Default)]
pub(super) struct Playhead {
    /// Seconds from the start of the music; `None` if nothing is played.
    position_s: Option<f64>,
}

impl Playhead {
    /// Fills a device's buffer, in which each frame has one sample for every channel. `target_s` is the wanted position in
    /// the music, seconds, for the first sample; `None` for silence.
    pub fn fill(
        &mut self,
        samples: &mut [f32],
        (channels, rate_hz): (usize, f64),
        music: Option<&LoudMusic>,
        target_s: Option<f64>,
    ) {
        let (Some(music), Some(target_s)) = (music, target_s) else {
            samples.fill(0.0);
            self.position_s = None;
            return;
        };
        let position_s = self.position_s.filter(|position_s| (position_s - target_s).abs() <= FAR_S);
        let mut position_s = position_s.unwrap_or(target_s);
        let off_s = position_s - target_s;
        let rate =
            if off_s.abs() < NEAR_S { 1.0 } else { 1.0 - (off_s / GONE_IN_S).clamp(-RATE_MAX, RATE_MAX) };
        for frame in samples.chunks_mut(channels.max(1)) {
            for (channel, sample) in frame.iter_mut().enumerate() {
                *sample = music.at(position_s, channel);
            }
            position_s += rate / rate_hz;
        }
        self.position_s = Some(position_s);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp on two channels: the first holds the position in seconds, the second its negative.
    fn ramp() -> LoudMusic {
        let samples = (0..1_000).flat_map(|frame| [frame as f32 / 100.0, -(frame as f32) / 100.0]).collect();
        LoudMusic { samples, channels: 2, rate_hz: 100.0 }
    }

    fn first(playhead: &mut Playhead, target_s: Option<f64>) -> [f32; 2] {
        let mut samples = [9.0; 100];
        playhead.fill(&mut samples, (2, 100.0), Some(&ramp()), target_s);
        [samples[0], samples[1]]
    }

    #[test]
    fn music_is_where_the_show_is_and_stands_with_it() {
        let mut playhead = Playhead::default();
        assert_eq!(first(&mut playhead, Some(2.0)), [2.0, -2.0]);
        // 50 frames later; off by 2 ms it goes on, off by a second it jumps.
        assert_eq!(first(&mut playhead, Some(2.498)), [2.5, -2.5]);
        assert_eq!(first(&mut playhead, Some(4.0)), [4.0, -4.0]);
        assert_eq!(first(&mut playhead, None), [0.0, 0.0]);
        assert_eq!(first(&mut playhead, Some(-3.0)), [0.0, 0.0]);
        assert_eq!(first(&mut playhead, Some(50.0)), [0.0, 0.0]);
    }

    #[test]
    fn small_errors_go_away_slowly() {
        let mut playhead = Playhead::default();
        first(&mut playhead, Some(1.0));
        let mut target_s = 1.48;
        let mut off_s = 0.02;
        for _ in 0..20 {
            first(&mut playhead, Some(target_s));
            target_s += 0.5;
            let now_s = playhead.position_s.unwrap() - target_s;
            assert!(now_s <= off_s + 1e-9 && off_s - now_s <= 0.0026, "{off_s} {now_s}");
            off_s = now_s;
        }
        assert!(off_s < 0.003, "{off_s}");
    }
}
