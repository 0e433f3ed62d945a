//! Seeded mutations of good files: each is read, or refused with one line, and never panics.

mod extras;
mod mutator;
mod numbers;

use extras::with_every_part;
use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::{FORMATS, read};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage, front_rows, validate};
use mutator::mutant;
use numbers::Numbers;

fn seed_show() -> Show {
    let pixel = |id: u32| Pixel {
        id,
        at: Vec2::new(f64::from(id) * 0.1, 0.5),
        color: Rgb::new(255, 165, 0),
        robot: (id == 1).then(|| "r\u{e4}1".to_owned()),
        ..Pixel::default()
    };
    let frame = Frame {
        name: "First \"ä\"\n".into(),
        air_time_s: 1.5,
        transition_s: Some(4.0),
        easing: Easing::Gentle,
        identity: Some(Identity::Fixed),
        pixels: (0..3).map(pixel).collect(),
        ..Frame::default()
    };
    with_every_part(Show {
        stage: Stage {
            obstacles: vec![Obstacle::Disc { at: Vec2::new(-1.0, 0.0), radius_m: 0.2 }],
            ..Stage::default()
        },
        starts: Some(vec![Vec2::new(0.1, 0.2); 2]),
        frames: vec![frame; 2],
        ..Show::default()
    })
}

#[test]
fn no_mutation_breaks_reading_or_validating() {
    let mut numbers = Numbers(2);
    let (mut were_read, mut refused) = (0, 0);
    for format in FORMATS {
        let good = format.write(&seed_show(), None).bytes;
        for _ in 0..4_000 {
            let bytes = mutant(&good, 3, &mut numbers);
            match read(&bytes, Some("a.json")) {
                Ok(loaded) => {
                    were_read += 1;
                    let lines = validate(&loaded.show);
                    assert!(lines.iter().chain(&loaded.issues).all(|issue| !issue.message.contains('\n')));
                    front_rows(&loaded.show.stage, 5);
                    let again =
                        read(&format.write(&loaded.show, None).bytes, None).expect("what we write we read");
                    assert_eq!(again.show.frames.len(), loaded.show.frames.len());
                }
                Err(error) => {
                    refused += 1;
                    let line = error.to_string();
                    assert!(!line.contains('\n') && line.len() < 400, "{line}");
                }
            }
        }
    }
    assert!(were_read > 500 && refused > 500, "{were_read} read, {refused} refused");
}
