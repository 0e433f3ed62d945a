//! Layers of a show: their settings, their faults, and when they are active.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_light::FloorPicture;
use lightbots_lighting::{DrivenLight, FrameTimes, LAYER_KINDS, LightMoment, ShowLight};
use lightbots_show::{Frame, FramePhase, Layer, LayerSpan, Setting, Show};

fn number(value: f64) -> Setting {
    Setting::Number(value)
}

fn text(value: &str) -> Setting {
    Setting::Text(value.into())
}

fn layer(kind: &str, span: LayerSpan, settings: Vec<(&str, Setting)>) -> Layer {
    let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    Layer { name: String::new(), kind: kind.into(), span, settings }
}

fn show(layers: Vec<Layer>) -> Show {
    let frame = |id: &str| Frame { id: Some(id.into()), air_time_s: 4.0, ..Frame::default() };
    Show { layers, frames: vec![frame("one"), frame("two"), frame("three")], ..Show::default() }
}

fn red(span: LayerSpan) -> Layer {
    layer("solid", span, vec![("palette", Setting::List(vec![text("#ff0000")]))])
}

/// Times of a frame for drives of 2 s and air times of 4 s, as in `show`.
fn times(frame: usize) -> Option<FrameTimes> {
    let mut times = FrameTimes::after(None, 2.0, 4.0);
    for _ in 0..frame {
        times = FrameTimes::after(Some(times.end_s), 2.0, 4.0);
    }
    Some(times)
}

/// The colour of a standing robot with a blue pixel.
fn colour(light: &ShowLight, frame: usize, show_s: f64, lead_s: f64) -> Rgb {
    let robot = DrivenLight {
        number: (0, 1),
        frame: frame as u32,
        pixel: Some(5),
        colours: [Rgb::new(0, 0, 255); 3],
        shines: [true; 2],
        path: None,
        goal: Vec2::ZERO,
        drive: Span::ZERO,
    };
    let moment = LightMoment { elapsed: Span::from_secs(1.0), show_s, lead_s, clock_s: 0.0 };
    robot.colour(&light.in_frame(frame, times), light.pictures(), moment)
}

fn no_picture(_: &str) -> Option<FloorPicture> {
    None
}

const RED: Rgb = Rgb::new(255, 0, 0);
const BLUE: Rgb = Rgb::new(0, 0, 255);

#[test]
fn a_layer_shines_in_its_frames_and_their_parts() {
    let span =
        |first: &str, last: &str, phase| LayerSpan::Frames { first: first.into(), last: last.into(), phase };
    // For each frame, whether it is red in the drive and in the air time. The drive to frame n begins at 6n − 2 s.
    let seen = |span: LayerSpan| {
        let (light, faults) = ShowLight::with_pictures(&show(vec![red(span)]), no_picture);
        assert_eq!(faults, []);
        let at = |frame: usize, s: f64| colour(&light, frame, 6.0 * frame as f64 + s, 0.0) == RED;
        (0..3).map(|frame| [at(frame, -1.0), at(frame, 1.0)]).collect::<Vec<_>>()
    };
    let (none, all) = ([false, false], [true, true]);
    assert_eq!(seen(LayerSpan::Show), [all, all, all]);
    assert_eq!(seen(span("two", "three", FramePhase::Whole)), [none, all, all]);
    assert_eq!(seen(span("one", "two", FramePhase::Transition)), [[true, false], [true, false], none]);
    assert_eq!(seen(span("two", "two", FramePhase::Picture)), [none, [false, true], none]);
    assert_eq!(seen(LayerSpan::Seconds { from_s: 0.0, to_s: 6.5 }), [[false, true], [true, false], none]);
}

#[test]
fn the_time_of_a_layer_counts_from_its_begin_and_a_free_one_is_ahead() {
    let fade = |free: bool| {
        let span = LayerSpan::Frames { first: "two".into(), last: "two".into(), phase: FramePhase::Picture };
        let settings = vec![("speed_hz", number(0.25)), ("runs_freely", Setting::Bool(free))];
        ShowLight::with_pictures(&show(vec![layer("fade", span, settings)]), no_picture).0
    };
    // The air time of the second frame begins at 6 s. The layer fades from black to white in 4 s.
    assert_eq!(colour(&fade(false), 1, 6.0, 2.0), Rgb::BLACK);
    assert_eq!(colour(&fade(false), 1, 8.0, 0.0), Rgb::new(188, 188, 188));
    assert_eq!(colour(&fade(true), 1, 6.0, 2.0), Rgb::new(188, 188, 188));
}

#[test]
fn every_kind_is_read_and_what_is_wrong_is_named() {
    for kind in LAYER_KINDS {
        let picture =
            |hash: &str| (hash == "f00d").then(|| FloorPicture::new(1, 1, vec![RED]).expect("one pixel"));
        let settings =
            if matches!(kind, "picture" | "sequence") { vec![("picture", text("f00d"))] } else { Vec::new() };
        let speed = if matches!(kind, "strobe" | "pulse") { 2.0 } else { 5.0 };
        let settings = settings.into_iter().chain([("speed_hz", number(speed))]).collect();
        let (light, faults) =
            ShowLight::with_pictures(&show(vec![layer(kind, LayerSpan::Show, settings)]), picture);
        assert_eq!((light.is_empty(), faults.as_slice()), (false, [].as_slice()), "{kind}");
    }
    let said = |kind: &str, settings: Vec<(&str, Setting)>| {
        let (_, faults) =
            ShowLight::with_pictures(&show(vec![layer(kind, LayerSpan::Show, settings)]), no_picture);
        faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let list = Setting::List;
    insta::assert_snapshot!(
        [
            said("sparkles", vec![]),
            said("strobe", vec![("speed_hz", number(1_000.0))]),
            said("wave", vec![("along", text("sideways")), ("size_m", text("big"))]),
            said("solid", vec![("palette", list(vec![text("red")]))]),
            said("solid", vec![("palette", list(vec![]))]),
            said("solid", vec![("opacity", list(vec![number(1.0)])), ("seed", number(-1.0))]),
            said("solid", vec![("masks", list(vec![Setting::Object(vec![("shape".into(), text("star"))])]))]),
            said("picture", vec![("picture", text("cafe"))]),
            said("fire", vec![("speed", number(1.0))]),
            said("chase", vec![("along", text("curve"))]),
        ]
        .join("\n")
    );
}

#[test]
fn a_wrong_layer_stays_dark_and_the_others_shine() {
    let layers = vec![layer("sparkles", LayerSpan::Show, Vec::new()), red(LayerSpan::Show)];
    let (light, faults) = ShowLight::with_pictures(&show(layers), no_picture);
    assert_eq!((faults.len(), colour(&light, 0, 1.0, 0.0)), (1, RED));
}

#[test]
fn a_mask_picks_pixels_by_their_ids() {
    let mask = |ids: &[f64]| {
        let ids = Setting::List(ids.iter().map(|&id| number(id)).collect());
        let mask = Setting::Object(vec![("shape".into(), text("pixels")), ("pixels".into(), ids)]);
        let palette = ("palette", Setting::List(vec![text("#ff0000")]));
        let masked = layer("solid", LayerSpan::Show, vec![palette, ("masks", Setting::List(vec![mask]))]);
        let (light, faults) = ShowLight::with_pictures(&show(vec![masked]), no_picture);
        assert_eq!(faults, []);
        colour(&light, 0, 1.0, 0.0)
    };
    assert_eq!((mask(&[9.0, 5.0]), mask(&[4.0])), (RED, BLUE));
}

#[test]
fn too_many_faults_are_cut() {
    let layers = vec![layer("sparkles", LayerSpan::Show, Vec::new()); 1_000];
    assert_eq!(ShowLight::with_pictures(&show(layers), no_picture).1.len(), lightbots_light::FAULTS_MAX);
}
