//! A show with every part of version 2 of our format.

use lightbots_base::Vec2;
use lightbots_show::{
    Asset, AssetHash, BeatGrid, Beats, Cue, CuePlace, FloorBox, FramePhase, FrameSource, Layer, LayerSpan,
    Marker, PictureMotion, Section, Setting, Show, SourceKind, SourcePart, Trajectory, TrajectoryPiece,
};

/// Adds every field of version 2 to a show of at least one frame with at least three pixels.
pub fn with_every_part(show: Show) -> Show {
    let hash = AssetHash([0xa7; 32]);
    let mut show = Show {
        spares: 2,
        assets: [(
            hash,
            Asset {
                name: "logo.svg".into(),
                media_type: "image/svg+xml".into(),
                bytes: 1_234,
                content: None,
                picture: None,
            },
        )]
        .into(),
        beats: Some(Beats { grid: BeatGrid::Steady { bpm: 120.0, offset_s: 0.35 }, per_bar: 4 }),
        sections: vec![Section { name: "Verse".into(), from_s: 0.0, to_s: 16.0 }],
        markers: vec![Marker { name: "Drop".into(), at_s: 12.5 }],
        cues: vec![Cue {
            name: "Curtain".into(),
            at: CuePlace::Frame("one".into()),
            loop_from: Some("one".into()),
        }],
        layers: vec![Layer {
            name: "Sparks".into(),
            kind: "sparkle".into(),
            span: LayerSpan::Frames { first: "one".into(), last: "one".into(), phase: FramePhase::Picture },
            settings: vec![("speed_hz".into(), Setting::Number(10.0))],
        }],
        trajectories: vec![Trajectory {
            frame: Some("one".into()),
            pixel: 0,
            at_s: 0.0,
            start: Vec2::new(-0.5, 0.0),
            pieces: vec![TrajectoryPiece { end_s: 2.0, controls: None, end: Vec2::new(0.5, 0.0) }],
        }],
        ..show
    };
    let frame = &mut show.frames[0];
    frame.id = Some("one".into());
    frame.at_s = Some(12.5);
    frame.motion = Some(PictureMotion::Turn { center: Vec2::new(0.1, 0.2), turn: 1.5, size: 1.2 });
    frame.sources = vec![FrameSource {
        asset: Some(hash),
        seed: 7,
        floor_box: Some(FloorBox { min: Vec2::new(-1.0, -0.5), max: Vec2::new(1.0, 0.5) }),
        moved: vec![2],
        series: Some("logo".into()),
        moment_s: Some(0.4),
        settings: vec![("outline".into(), Setting::Bool(true))],
        ..FrameSource::new(SourceKind::Svg)
    }];
    frame.pixels[1].part = Some(SourcePart { source: 0, name: "eye".into() });
    frame.pixels[1].group = Some("Face".into());
    show
}
