//! Whole pictures: counts, distances, floors, no-go areas, moved lights.

use lightbots_base::{Rgb, Vec2};

use crate::drawing::{Area, Drawing, DrawingPart, FillRule, Raster, Stroke};
use crate::fit::{NoGo, PictureFloor};
use crate::ground::Quality;
use crate::layout::Style;
use crate::place::{Placed, place};
use crate::settings::{PlaceSettings, PlacedLight};

const ORANGE: Rgb = Rgb::new(255, 160, 0);

fn points(list: &[(f64, f64)]) -> Vec<Vec2> {
    list.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
}

fn area(rings: Vec<Vec<Vec2>>) -> Area {
    Area { rings, rule: FillRule::EvenOdd, ink: ORANGE.into(), weight: 1.0 }
}

fn square() -> Drawing {
    let ring = points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    Drawing { parts: vec![DrawingPart { areas: vec![area(vec![ring])], ..DrawingPart::default() }] }
}

fn letter_h() -> Drawing {
    let ring = points(&[
        (0.0, 0.0),
        (0.2, 0.0),
        (0.2, 0.4),
        (0.5, 0.4),
        (0.5, 0.0),
        (0.7, 0.0),
        (0.7, 1.0),
        (0.5, 1.0),
        (0.5, 0.6),
        (0.2, 0.6),
        (0.2, 1.0),
        (0.0, 1.0),
    ]);
    Drawing {
        parts: vec![DrawingPart {
            areas: vec![area(vec![ring])],
            letter: Some('H'),
            ..DrawingPart::default()
        }],
    }
}

fn cross() -> Drawing {
    let stroke =
        |ends: &[(f64, f64)]| Stroke { points: points(ends), closed: false, ink: ORANGE.into(), weight: 1.0 };
    let strokes = vec![stroke(&[(-1.0, 0.0), (1.0, 0.0)]), stroke(&[(0.0, -1.0), (0.0, 1.0)])];
    Drawing { parts: vec![DrawingPart { strokes, ..DrawingPart::default() }] }
}

fn made(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Placed {
    place(drawing, floor, settings).unwrap()
}

fn floor() -> PictureFloor {
    PictureFloor::new(6.0, 6.0, 0.1)
}

fn closest(lights: &[PlacedLight]) -> f64 {
    let pairs =
        lights.iter().enumerate().flat_map(|(i, a)| lights[i + 1..].iter().map(|b| a.at.distance(b.at)));
    pairs.fold(f64::INFINITY, f64::min)
}

#[test]
fn every_count_in_every_style_keeps_spacing_and_floor() {
    for drawing in [square(), letter_h(), cross()] {
        for style in [Style::Auto, Style::Filled, Style::Outline, Style::Both, Style::Lines] {
            for robots in [1, 2, 3, 7, 30, 101] {
                let settings = PlaceSettings { robots, style, ..PlaceSettings::default() };
                let placed = made(&drawing, &floor(), &settings);
                assert_eq!(placed.lights.len(), robots, "{style:?}");
                assert!(
                    closest(&placed.lights) >= 0.08 * 0.999_999,
                    "{robots} {style:?} {}",
                    placed.closest_m
                );
                assert!(placed.lights.iter().all(|light| floor().allows(light.at)), "{robots} {style:?}");
            }
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    let settings = |seed| PlaceSettings {
        robots: 40,
        style: Style::Filled,
        seed,
        kept: Vec::new(),
        ..PlaceSettings::default()
    };
    let lights = |seed| made(&square(), &floor(), &settings(seed)).lights;
    assert_eq!(lights(5), lights(5));
    assert_ne!(lights(5), lights(6));
}

#[test]
fn too_many_robots_are_refused_with_a_number_that_does() {
    let small = PictureFloor::new(1.2, 1.2, 0.1);
    let ask = |robots| place(&square(), &small, &PlaceSettings { robots, ..PlaceSettings::default() });
    let error = ask(500).unwrap_err();
    assert_eq!(error.code, "too-many-robots");
    let words: Vec<&str> = error.message.split(' ').collect();
    let about = words.iter().position(|word| *word == "about").unwrap();
    let fitting: usize = words[about + 1].parse().unwrap();
    assert!(fitting > 100, "{}", error.message);
    assert!(ask(fitting).is_ok(), "{}", error.message);
}

#[test]
fn a_size_that_is_too_small_grows_and_says_so() {
    let settings = PlaceSettings { robots: 100, size_m: Some(0.3), ..PlaceSettings::default() };
    let placed = made(&square(), &floor(), &settings);
    assert!(placed.size_m > 0.7);
    assert_eq!(placed.notes[0].code, "enlarged");
}

#[test]
fn no_light_stands_in_a_no_go_area() {
    let mut floor = floor();
    floor.no_go.push(NoGo::Disc { at: Vec2::new(0.1, 0.0), radius_m: 0.5 });
    floor.no_go.push(NoGo::Rect { min: Vec2::new(-3.0, 1.0), max: Vec2::new(3.0, 1.1), margin_m: 0.05 });
    for drawing in [square(), letter_h(), cross()] {
        let settings = PlaceSettings { robots: 60, size_m: Some(4.0), ..PlaceSettings::default() };
        let placed = made(&drawing, &floor, &settings);
        assert_eq!(placed.lights.len(), 60);
        assert!(placed.lights.iter().all(|light| floor.allows(light.at)));
        assert!(closest(&placed.lights) >= 0.08 * 0.999_999);
    }
}

#[test]
fn lights_that_were_moved_stay_and_count_first() {
    let kept = vec![PlacedLight { at: Vec2::new(0.3, 0.2), color: Rgb::new(0, 0, 255), part: 0 }];
    for style in [Style::Filled, Style::Both, Style::Outline] {
        let settings = PlaceSettings { robots: 30, style, kept: kept.clone(), ..PlaceSettings::default() };
        let placed = made(&square(), &floor(), &settings);
        assert_eq!(placed.lights[0], kept[0]);
        assert_eq!(placed.lights.len(), 30);
        assert!(closest(&placed.lights) >= 0.08 * 0.999_999);
    }
}

#[test]
fn a_symmetric_letter_has_as_many_lights_left_as_right() {
    for robots in 9..60 {
        let placed = made(&letter_h(), &floor(), &PlaceSettings { robots, ..PlaceSettings::default() });
        let left = placed.lights.iter().filter(|light| light.at.x < -1e-6).count();
        let right = placed.lights.iter().filter(|light| light.at.x > 1e-6).count();
        assert_eq!(left, right, "{robots}");
    }
}

#[test]
fn more_robots_show_a_letter_better() {
    let correlation = |robots| {
        made(&letter_h(), &floor(), &PlaceSettings { robots, ..PlaceSettings::default() })
            .readability
            .correlation
    };
    assert!(correlation(4) < crate::readability::DOUBTFUL);
    assert!(correlation(13) > crate::readability::READABLE);
}

#[test]
fn a_preview_has_as_many_lights_as_the_result() {
    let settings = PlaceSettings { robots: 200, quality: Quality::Quick, ..PlaceSettings::default() };
    let placed = made(&letter_h(), &floor(), &settings);
    assert_eq!(placed.lights.len(), 200);
    assert!(closest(&placed.lights) >= 0.08 * 0.999_999);
}

#[test]
fn wrong_numbers_are_refused() {
    let refused = |settings: PlaceSettings| place(&square(), &floor(), &settings).unwrap_err().code;
    assert_eq!(refused(PlaceSettings { robots: 0, ..PlaceSettings::default() }), "bad-setting");
    assert_eq!(refused(PlaceSettings { spacing_m: f64::NAN, ..PlaceSettings::default() }), "bad-setting");
    assert_eq!(refused(PlaceSettings { size_m: Some(-1.0), ..PlaceSettings::default() }), "bad-setting");
    assert_eq!(
        refused(PlaceSettings { center: Vec2::new(9.0, 0.0), ..PlaceSettings::default() }),
        "off-the-floor"
    );
    let nothing = place(&Drawing::default(), &floor(), &PlaceSettings::default()).unwrap_err();
    assert_eq!(nothing.code, "nothing-to-draw");
}

#[test]
fn pictures_of_one_view_keep_its_scale_and_place() {
    // A square in the right half of a view that is four times as wide as the square.
    let view = Some((Vec2::new(-2.0, 0.0), Vec2::new(2.0, 1.0)));
    let settings = PlaceSettings { robots: 30, size_m: Some(4.0), view, ..PlaceSettings::default() };
    let placed = made(&square(), &floor(), &settings);
    assert!((placed.size_m - 4.0).abs() < 1e-9);
    assert!(
        placed.lights.iter().all(|light| light.at.x >= -1e-9 && light.at.x <= 1.0),
        "{:?}",
        placed.lights
    );
}

#[test]
fn a_picture_begun_from_one_elsewhere_is_as_good_as_a_new_one() {
    let fresh = made(
        &square(),
        &floor(),
        &PlaceSettings { robots: 40, style: Style::Filled, ..PlaceSettings::default() },
    );
    let apart = fresh.lights.iter().map(|light| light.at * 0.2 + Vec2::new(2.0, 1.0)).collect();
    let heap = vec![Vec2::new(0.5, 0.5); 40];
    for start in [apart, heap] {
        let settings = PlaceSettings { robots: 40, style: Style::Filled, start, ..PlaceSettings::default() };
        let warm = made(&square(), &floor(), &settings);
        assert!(
            warm.readability.correlation > fresh.readability.correlation - 0.02,
            "{:?}",
            warm.readability
        );
    }
}

#[test]
fn lines_that_are_too_short_for_the_robots_become_bands() {
    let small = PictureFloor::new(2.6, 2.6, 0.1);
    let refusal = place(
        &cross(),
        &small,
        &PlaceSettings { robots: 200, style: Style::Lines, ..PlaceSettings::default() },
    );
    assert_eq!(refusal.unwrap_err().code, "too-many-robots");
    for robots in [61, 100, 200] {
        let placed = made(&cross(), &small, &PlaceSettings { robots, ..PlaceSettings::default() });
        assert_eq!(placed.lights.len(), robots);
        assert!(closest(&placed.lights) >= 0.08 * 0.999_999);
        let off = |light: &&PlacedLight| light.at.x.abs().min(light.at.y.abs()) > 0.3;
        assert_eq!(placed.lights.iter().filter(off).count(), 0, "{robots} robots are still a cross");
    }
}

#[test]
fn lights_of_a_line_behind_an_area_keep_apart_from_those_of_the_area() {
    let mut drawing = square();
    let points = vec![Vec2::new(-0.5, 0.37), Vec2::new(1.5, 0.37)];
    drawing.parts[0].strokes = vec![Stroke { points, closed: false, ink: Rgb::BLACK.into(), weight: 1.0 }];
    for robots in [40, 150, 400] {
        let placed = made(
            &drawing,
            &PictureFloor::new(30.0, 30.0, 0.1),
            &PlaceSettings { robots, ..PlaceSettings::default() },
        );
        let places: Vec<Vec2> = placed.lights.iter().map(|light| light.at).collect();
        let mut distances = crate::buckets::nearest_distances(&places, 0.1);
        distances.sort_by(f64::total_cmp);
        let share = distances[0] / distances[robots / 2];
        assert!(share > 0.6, "{robots} robots: the closest pair at {share} of the usual distance");
    }
}

/// A picture three times as wide as high: its left third is red, the rest is dark.
fn picture() -> Drawing {
    let (columns, rows) = (30, 10);
    let is_red = |index: usize| index % columns < 10;
    let cells = 0..columns * rows;
    let raster = Raster {
        corners: [(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (0.0, 10.0)].map(|(x, y)| Vec2::new(x, y)),
        columns,
        colors: cells.clone().map(|index| if is_red(index) { Rgb::new(255, 0, 0) } else { ORANGE }).collect(),
        weights: cells.map(|index| if is_red(index) { 1.0 } else { 0.0 }).collect(),
    };
    Drawing { parts: vec![DrawingPart { raster: Some(raster), ..DrawingPart::default() }] }
}

#[test]
fn a_picture_is_turned_with_its_cells() {
    let floor = PictureFloor::new(4.0, 4.0, 0.05);
    for turn in [0.0, 0.5, core::f64::consts::FRAC_PI_2, 2.5, -1.0] {
        let settings = PlaceSettings { robots: 16, size_m: Some(2.4), turn, ..PlaceSettings::default() };
        let placed = made(&picture(), &floor, &settings);
        let red = Vec2::new(-0.8 * libm::cos(turn), -0.8 * libm::sin(turn));
        for light in &placed.lights {
            assert!(
                light.at.distance(red) < 0.6,
                "turn {turn}: {light:?} is not in the red third at {red:?}"
            );
            assert_eq!(light.color, Rgb::new(255, 0, 0), "turn {turn}");
        }
    }
}

#[test]
fn the_outline_of_a_thing_in_a_picture_is_not_filled() {
    let mut drawing = picture();
    let points = points(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
    drawing.parts[0].strokes = vec![Stroke { points, closed: true, ink: ORANGE.into(), weight: 1.0 }];
    let floor = PictureFloor::new(6.0, 6.0, 0.05);
    for style in [Style::Auto, Style::Outline, Style::Filled, Style::Both, Style::Lines] {
        let settings = PlaceSettings { robots: 40, size_m: Some(3.0), style, ..PlaceSettings::default() };
        let view = Some((Vec2::ZERO, Vec2::new(10.0, 10.0)));
        let placed = made(&drawing, &floor, &PlaceSettings { view, ..settings });
        for light in &placed.lights {
            let from_edge = 1.5 - light.at.x.abs().max(light.at.y.abs());
            assert!(from_edge.abs() < 0.1, "{style:?}: {light:?} is {from_edge} m inside the outline");
        }
    }
}
