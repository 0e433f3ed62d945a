//! Random shows with parts of version 2 of our format.

use crate::numbers::Numbers;
use lightbots_base::random::split_mix;
use lightbots_base::{Rgb, Vec2};
use lightbots_show::{
    Asset, AssetHash, BeatGrid, Beats, Cue, CuePlace, FloorBox, Frame, FramePhase, FrameSource, Layer,
    LayerSpan, Marker, Pixel, Section, Setting, Show, SourceKind, SourcePart, Trajectory, TrajectoryPiece,
};

impl Numbers {
    fn chance(&mut self) -> bool {
        self.below(2) == 0
    }

    /// A finite number of any magnitude.
    fn number(&mut self) -> f64 {
        match self.below(4) {
            0 => self.below(1_000) as f64,
            1 => (self.below(2_000_001) as f64 - 1e6) / 7e5,
            2 => 0.1 * self.below(100) as f64,
            _ => {
                let any = f64::from_bits(split_mix(&mut self.0));
                if any.is_finite() { any } else { -1e-320 }
            }
        }
    }

    fn text(&mut self) -> String {
        const LETTERS: [char; 12] =
            ['a', 'Z', '"', '\\', '\n', '\u{0}', 'ä', '😀', '{', ']', ' ', '\u{2028}'];
        (0..self.below(12)).map(|_| LETTERS[self.below(LETTERS.len())]).collect()
    }

    fn place(&mut self) -> Vec2 {
        Vec2::new(self.number(), self.number())
    }

    fn some<T>(&mut self, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.chance() { Some(value(self)) } else { None }
    }

    fn many<T>(&mut self, most: usize, mut value: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.below(most + 1)).map(|_| value(self)).collect()
    }

    fn setting(&mut self, depth: usize) -> Setting {
        match self.below(if depth == 0 { 4 } else { 6 }) {
            0 => Setting::Null,
            1 => Setting::Bool(self.chance()),
            2 => Setting::Number(self.number()),
            3 => Setting::Text(self.text()),
            4 => Setting::List(self.many(3, |numbers| numbers.setting(depth - 1))),
            _ => Setting::Object(self.settings(depth - 1)),
        }
    }

    fn settings(&mut self, depth: usize) -> Vec<(String, Setting)> {
        let count = self.below(4);
        (0..count).map(|nth| (format!("{nth}{}", self.text()), self.setting(depth))).collect()
    }

    fn hash(&mut self) -> AssetHash {
        let mut hash = [0; 32];
        hash.fill_with(|| self.below(256) as u8);
        AssetHash(hash)
    }

    fn source(&mut self) -> FrameSource {
        let mut moved: Vec<u32> = self.many(4, |numbers| numbers.below(1 << 32) as u32);
        moved.sort_unstable();
        moved.dedup();
        FrameSource {
            kind: SourceKind::ALL[self.below(6)],
            asset: self.some(Self::hash),
            seed: self.below(1 << 32) as u32,
            floor_box: self.some(|numbers| FloorBox { min: numbers.place(), max: numbers.place() }),
            moved,
            series: self.some(Self::text),
            moment_s: self.some(Self::number),
            settings: self.settings(3),
        }
    }

    fn layer(&mut self) -> Layer {
        let phases = [FramePhase::Whole, FramePhase::Transition, FramePhase::Picture];
        let span = match self.below(3) {
            0 => LayerSpan::Show,
            1 => LayerSpan::Frames { first: self.text(), last: self.text(), phase: phases[self.below(3)] },
            _ => LayerSpan::Seconds { from_s: self.number(), to_s: self.number() },
        };
        Layer { name: self.text(), kind: self.text(), span, settings: self.settings(3) }
    }

    fn cue(&mut self) -> Cue {
        let at = if self.chance() { CuePlace::Frame(self.text()) } else { CuePlace::Seconds(self.number()) };
        Cue { name: self.text(), at, loop_from: self.some(Self::text) }
    }

    fn beats(&mut self) -> Beats {
        let grid = if self.chance() {
            BeatGrid::Steady { bpm: self.number(), offset_s: self.number() }
        } else {
            BeatGrid::Times(self.many(5, Self::number))
        };
        Beats { grid, per_bar: self.below(9) as u32 }
    }

    fn trajectory(&mut self) -> Trajectory {
        let piece = |numbers: &mut Self| TrajectoryPiece {
            end_s: numbers.number(),
            controls: numbers.some(|numbers| [numbers.place(), numbers.place()]),
            end: numbers.place(),
        };
        Trajectory {
            frame: self.some(Self::text),
            pixel: self.below(100) as u32,
            at_s: self.number(),
            start: self.place(),
            pieces: self.many(3, piece),
        }
    }

    fn frame(&mut self) -> Frame {
        let pixel = |id: usize, numbers: &mut Self| Pixel {
            id: id as u32,
            at: Vec2::new(0.1 * id as f64, 0.0),
            color: Rgb::new(255, 165, 0),
            part: numbers
                .some(|numbers| SourcePart { source: numbers.below(3) as u32, name: numbers.text() }),
            group: numbers.some(Self::text),
            ..Pixel::default()
        };
        Frame {
            id: self.some(Self::text),
            at_s: self.some(Self::number),
            sources: self.many(2, Self::source),
            pixels: (0..self.below(4)).map(|id| pixel(id, self)).collect(),
            ..Frame::default()
        }
    }

    fn asset(&mut self) -> Asset {
        let bytes = self.below(1 << 32) as u64;
        Asset { name: self.text(), media_type: self.text(), bytes, content: None, picture: None }
    }

    /// A show with random parts of version 2. It may be invalid.
    pub fn show(&mut self) -> Show {
        Show {
            spares: self.below(3) as u32,
            assets: self.many(3, |numbers| (numbers.hash(), numbers.asset())).into_iter().collect(),
            beats: self.some(Self::beats),
            sections: self.many(2, |numbers| Section {
                name: numbers.text(),
                from_s: numbers.number(),
                to_s: numbers.number(),
            }),
            markers: self.many(2, |numbers| Marker { name: numbers.text(), at_s: numbers.number() }),
            cues: self.many(2, Self::cue),
            layers: self.many(3, Self::layer),
            trajectories: self.many(2, Self::trajectory),
            frames: self.many(3, Self::frame),
            ..Show::default()
        }
    }
}
