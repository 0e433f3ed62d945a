use lightbots_base::random::split_mix;

use lightbots_base::{Rgb, Vec2};

use super::region::LetterArea;
use super::*;
use crate::drawing::DrawingPart;
use crate::error::Made;
use crate::geometry::bounds;

fn lato() -> Font {
    Font::built_in("lato").unwrap()
}

fn made(words: &str) -> Made {
    draw(&TextSettings::new(words, &lato())).unwrap()
}

fn names(made: &Made) -> Vec<&str> {
    made.drawing.parts.iter().map(|part| part.name.as_str()).collect()
}

fn extent(part: &DrawingPart) -> (Vec2, Vec2) {
    bounds(part.areas.iter().flat_map(|area| area.rings.iter().flatten())).unwrap()
}

fn code(words: &str) -> &'static str {
    draw(&TextSettings::new(words, &lato())).unwrap_err().code
}

#[test]
fn every_font_inside_is_read_and_draws_capitals_one_high() {
    for info in FONTS.iter().filter(|info| info.offered) {
        let font = Font::built_in(info.name).unwrap();
        let made = draw(&TextSettings::new("H", &font)).unwrap();
        let (low, high) = made.drawing.bounds().unwrap();
        assert!((low.y.abs() < 0.02) && (high.y - 1.0).abs() < 0.02, "{}: {low:?} to {high:?}", info.name);
        assert_eq!(font.is_single_line(), made.drawing.parts[0].areas.is_empty(), "{}", info.name);
    }
    assert!(Font::built_in("times").is_none());
}

#[test]
fn letters_are_groups_with_names_of_their_own() {
    let made = made("HAHA I");
    assert_eq!(names(&made), ["H 1", "A 1", "H 2", "A 2", "I 1"]);
    assert_eq!(made.drawing.parts[1].letter, Some('A'));
    assert!(made.notes.is_empty());
}

#[test]
fn letters_follow_each_other_with_kerning() {
    let width = |words: &str| made(words).drawing.bounds().unwrap().1.x;
    let (pair, single) = (width("AV"), width("A") + width("V"));
    assert!(pair < single - 0.05, "{pair} {single}");
    let font = lato();
    let spaced = draw(&TextSettings { letter_gap: 0.5, ..TextSettings::new("AV", &font) }).unwrap();
    assert!((spaced.drawing.bounds().unwrap().1.x - pair - 0.5).abs() < 1e-9);
}

#[test]
fn accents_are_drawn_and_have_strokes() {
    for word in ["č", "ő", "ş", "İ", "ğ", "é", "Ż", "ü", "ł", "Ł"] {
        let made = made(word);
        let part = &made.drawing.parts[0];
        assert_eq!(part.letter, word.chars().next());
        assert!(made.notes.is_empty() && !part.areas.is_empty(), "{word}");
        assert!(part.spine.len() >= 2, "{word} has {} strokes", part.spine.len());
    }
    // The same letter as two characters.
    assert_eq!(made("e\u{301}").drawing, made("é").drawing);
}

#[test]
fn spines_lie_inside_of_their_letters() {
    let words = "ABCDEFGHIJKLMNOPQRSTUVWXYZ abcdefghijklmnopqrstuvwxyz 0123456789";
    for info in FONTS.iter().filter(|info| info.offered) {
        let font = Font::built_in(info.name).unwrap();
        let mut bare = Vec::new();
        for part in draw(&TextSettings::new(words, &font)).unwrap().drawing.parts {
            let Some(area) = part.areas.first() else { continue };
            let whole = LetterArea::new(&area.rings).unwrap();
            if part.spine.is_empty() {
                bare.push(part.name.clone());
            }
            for point in part.spine.iter().flat_map(|stroke| &stroke.points) {
                let near = whole.contains(*point) || whole.distance(*point) < whole.stem / 4.0;
                assert!(near, "{} in {}: {point:?}", part.name, info.name);
            }
        }
        assert!(bare.is_empty(), "{}: no strokes for {bare:?}", info.name);
    }
}

#[test]
fn lines_stand_below_each_other_and_are_aligned() {
    let font = lato();
    let boxes = |align| {
        let made = draw(&TextSettings { align, ..TextSettings::new("\nII\nI\r\nIII\n", &font) }).unwrap();
        made.drawing.parts.iter().map(extent).collect::<Vec<(Vec2, Vec2)>>()
    };
    let (left, right, centre) = (boxes(Align::Left), boxes(Align::Right), boxes(Align::Centre));
    assert_eq!(left.len(), 6);
    assert!(left[0].0.y.abs() < 1e-9, "the first baseline is {}", left[0].0.y);
    assert!((left[2].1.y + 0.4 - left[0].0.y).abs() < 1e-9 && (left[3].1.y + 0.4 - left[2].0.y).abs() < 1e-9);
    assert!(left[2].0.x.abs() < 1e-9 && (right[2].1.x - right[5].1.x).abs() < 1e-9);
    assert!((centre[2].0.x - (left[2].0.x + right[2].0.x) / 2.0).abs() < 1e-9);
}

#[test]
fn words_wrap_into_the_lines_that_fill_a_ratio() {
    let font = lato();
    let rows = |ratio| {
        let settings = TextSettings { wrap: Some(ratio), ..TextSettings::new("ONE TWO SIX TEN", &font) };
        let made = draw(&settings).unwrap();
        assert_eq!(made.drawing.parts.len(), 12);
        let mut feet: Vec<i64> =
            made.drawing.parts.iter().map(|part| (extent(part).0.y * 5.0).round() as i64).collect();
        feet.sort_unstable();
        feet.dedup();
        feet.len()
    };
    assert_eq!([rows(20.0), rows(1.8), rows(0.2)], [1, 2, 4]);
}

#[test]
fn hebrew_is_read_from_the_right_and_latin_in_it_from_the_left() {
    let made = made("שלום AB 12");
    assert_eq!(names(&made), ["ש 1", "ל 1", "ו 1", "ם 1", "A 1", "B 1", "1 1", "2 1"]);
    let at: Vec<f64> = made.drawing.parts.iter().map(|part| extent(part).0.x).collect();
    let mut order: Vec<usize> = (0..at.len()).collect();
    order.sort_by(|a, b| at[*a].total_cmp(&at[*b]));
    // As seen from the left: AB 12 in order, then shalom from its last letter to its first.
    assert_eq!(order, [4, 5, 6, 7, 3, 2, 1, 0]);
}

#[test]
fn arabic_letters_are_joined() {
    let alone = made("ب").drawing.bounds().unwrap();
    let joined = made("ببب");
    assert_eq!(joined.drawing.parts.len(), 3);
    let (low, high) = joined.drawing.bounds().unwrap();
    assert!(high.x - low.x < 2.5 * (alone.1.x - alone.0.x), "{} {}", high.x, alone.1.x);
    let font = lato();
    let spaced = draw(&TextSettings { letter_gap: 1.0, ..TextSettings::new("ببب", &font) }).unwrap();
    assert_eq!(spaced.drawing, joined.drawing, "a gap would tear joined letters");
}

#[test]
fn strokes_of_straight_letters_are_straight() {
    let font = Font::built_in("quicksand").unwrap();
    let made = draw(&TextSettings::new("HLE", &font)).unwrap();
    for part in &made.drawing.parts {
        for pair in part.spine.iter().flat_map(|stroke| stroke.points.windows(2)) {
            let way = pair[1] - pair[0];
            assert!(way.x.abs().min(way.y.abs()) < 0.01, "{}: {way:?}", part.name);
        }
    }
}

#[test]
fn emoji_stand_on_the_line_beside_letters() {
    let made = made("HI 😀❤️");
    assert_eq!(made.drawing.parts.len(), 4);
    assert!(made.notes.is_empty(), "{:?}", made.notes);
    let (low, high) = extent(&made.drawing.parts[2]);
    assert!((low.y + 0.05).abs() < 0.01 && (high.y - 1.05).abs() < 0.01, "{low:?} {high:?}");
}

#[test]
fn a_sign_without_a_font_is_named() {
    let made = made("A\u{1f9ff}漢漢");
    assert_eq!(names(&made), ["A 1"]);
    assert_eq!(made.notes.len(), 1);
    assert!(made.notes[0].message.contains("漢 (U+6F22)") && made.notes[0].message.starts_with("3 signs"));
    assert_eq!(code("漢"), "text-no-glyphs");
}

#[test]
fn a_mark_without_a_font_is_named_and_its_letter_drawn() {
    let marked = made("A\u{3099}");
    assert!(marked.notes[0].message.contains("U+3099"), "{:?}", marked.notes);
    assert_eq!(marked.drawing.parts[0].areas, made("A").drawing.parts[0].areas);
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    assert_eq!([code(""), code(" \n\t "), code("\u{200b}\u{200d}")], ["text-empty"; 3]);
    assert_eq!(code(&"A".repeat(2_001)), "text-too-long");
    let font = lato();
    let strange = TextSettings { letter_gap: f64::NAN, ..TextSettings::new("A", &font) };
    assert_eq!(draw(&strange).unwrap_err().code, "text-settings");
}

#[test]
fn colours_follow_the_text() {
    let font = lato();
    let colors = |colors| {
        let made = draw(&TextSettings { colors, ..TextSettings::new("ABC", &font) }).unwrap();
        made.drawing.parts.iter().map(|part| part.areas[0].ink.color.number()).collect::<Vec<u32>>()
    };
    // The middle of the rainbow is halfway between green and cyan.
    assert_eq!(colors(Colors::Rainbow), [0xff_0000, 0x00_ff80, 0xff_00ff]);
    let two = vec![Rgb::new(1, 0, 0), Rgb::new(2, 0, 0)];
    assert_eq!(colors(Colors::Each(two)), [0x01_0000, 0x02_0000, 0x01_0000]);
}

#[test]
fn a_word_is_a_page() {
    let font = lato();
    let pages = per_word(&TextSettings::new("ON\n 漢 OFF", &font)).unwrap();
    let titles: Vec<&str> = pages.iter().map(|page| page.title.as_str()).collect();
    assert_eq!(titles, ["ON", "OFF"]);
    assert_eq!(pages[0].made.notes[0].code, "text-missing-word");
    assert_eq!(per_word(&TextSettings::new("漢", &font)).unwrap_err().code, "text-no-glyphs");
}

#[test]
fn a_text_scrolls_from_its_first_to_its_last_letters() {
    let font = lato();
    let pages = scrolling(&TextSettings::new("HELLO\nWORLD", &font), 2.0, 9).unwrap();
    assert_eq!(pages.len(), 9);
    assert_eq!(names(&pages[0].made)[0], "H 1");
    assert_eq!(names(&pages[8].made).last(), Some(&"D 1"));
    for page in &pages {
        let (low, high) = page.made.drawing.bounds().unwrap();
        assert!(low.x >= -1e-9 && high.x <= 2.0 + 1e-9, "{}: {low:?} {high:?}", page.title);
    }
    let narrow = scrolling(&TextSettings::new("I", &font), 3.0, 2).unwrap();
    let [first, last] = [0, 1].map(|at| extent(&narrow[at].made.drawing.parts[0]));
    assert!((first.1.x - 3.0).abs() < 1e-9 && last.0.x.abs() < 1e-9);
    assert_eq!(scrolling(&TextSettings::new("I", &font), 3.0, 0).unwrap_err().code, "text-settings");
}

/// The smallest built-in font with outlines.
const SMALL: &[u8] = include_bytes!("../../fonts/NotoSansHebrew-Bold-part.ttf");

/// Checks that a font file that can be read is drawn or refused, without a panic.
fn try_font(bytes: &[u8]) {
    if let Ok(font) = Font::read(bytes) {
        let _ = draw(&TextSettings::new("שלום Ab", &font));
    }
}

#[test]
fn fonts_cut_off_anywhere_are_refused() {
    for end in (0..SMALL.len()).step_by(97) {
        assert!(Font::read(&SMALL[..end]).is_err(), "cut off after {end} bytes");
    }
    assert_eq!(Font::read(&SMALL[..SMALL.len() - 8]).err().unwrap().code, "font-cut-off");
    assert_eq!(Font::read(b"wOF2....").err().unwrap().code, "font-web");
}

#[test]
fn fonts_with_flipped_bytes_are_refused_or_drawn() {
    let mut state = 25;
    for _ in 0..400 {
        let mut bytes = SMALL.to_vec();
        for _ in 0..=split_mix(&mut state) % 12 {
            // Half of the flips hit the headers of the tables, where they have most effect.
            let among = if split_mix(&mut state).is_multiple_of(2) { 600 } else { bytes.len() as u64 };
            let at = (split_mix(&mut state) % among) as usize;
            bytes[at] = split_mix(&mut state) as u8;
        }
        try_font(&bytes);
    }
}

#[test]
fn noise_is_no_font() {
    let mut state = 7;
    for length in [0, 1, 4, 12, 300, 2_000] {
        let noise: Vec<u8> = (0..length).map(|_| split_mix(&mut state) as u8).collect();
        assert_eq!(Font::read(&noise).err().unwrap().code, "font-unreadable");
    }
}

#[test]
fn a_text_of_the_greatest_length_is_drawn() {
    let words = "Żółw & jeż ".repeat(181);
    let made = draw(&TextSettings { wrap: Some(1.5), ..TextSettings::new(&words, &lato()) }).unwrap();
    assert_eq!(made.drawing.parts.len(), 181 * 8);
}
