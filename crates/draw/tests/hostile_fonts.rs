//! Small fonts whose letters would take very much time or memory.

use std::time::{Duration, Instant};

use lightbots_draw::text::{Font, TextSettings, draw};

/// Longest time for one of these fonts. The slowest took 0.6 s on 2026-11-24, in a debug build on a busy machine.
const LONGEST: Duration = Duration::from_secs(5);

fn put(into: &mut Vec<u8>, numbers: &[u16]) {
    into.extend(numbers.iter().flat_map(|number| number.to_be_bytes()));
}

/// A font that maps A to its last glyph.
fn font(glyphs: &[Vec<u8>], layout: Option<Vec<u8>>) -> Vec<u8> {
    let count = glyphs.len() as u16;
    let (mut glyf, mut loca) = (Vec::new(), vec![0_u8; 4]);
    for glyph in glyphs {
        glyf.extend(glyph);
        loca.extend((glyf.len() as u32).to_be_bytes());
    }
    let mut head = vec![0_u8; 54];
    head[..4].copy_from_slice(&[0, 1, 0, 0]);
    head[12..16].copy_from_slice(&[0x5f, 0x0f, 0x3c, 0xf5]);
    head[18..20].copy_from_slice(&1_000_u16.to_be_bytes());
    head[51] = 1;
    let mut maxp = vec![0, 1, 0, 0];
    put(&mut maxp, &[count, 100, 10, 9_999, 9_999, 1, 0, 0, 0, 0, 0, 0, 99, 99]);
    let mut cmap = Vec::new();
    put(&mut cmap, &[0, 1, 3, 1, 0, 12, 4, 32, 0, 4, 4, 1, 0, 65, 0xffff, 0, 65, 0xffff]);
    put(&mut cmap, &[count.wrapping_sub(1).wrapping_sub(65), 1, 0, 0]);
    let mut hhea = vec![0, 1, 0, 0];
    put(&mut hhea, &[800, 200, 0, 1_000, 0, 0, 1_000, 1, 0, 0, 0, 0, 0, 0, 0, 1]);
    let mut hmtx = Vec::new();
    put(&mut hmtx, &vec![500; count as usize + 1]);
    let mut tables: Vec<(&[u8; 4], Vec<u8>)> = vec![
        (b"cmap", cmap),
        (b"glyf", glyf),
        (b"head", head),
        (b"hhea", hhea),
        (b"hmtx", hmtx),
        (b"loca", loca),
        (b"maxp", maxp),
    ];
    tables.extend(layout.map(|layout| (b"GSUB", layout)));
    tables.sort_by_key(|(name, _)| **name);
    let mut bytes = vec![0, 1, 0, 0];
    put(&mut bytes, &[tables.len() as u16, 0, 0, 0]);
    let mut end = 12 + 16 * tables.len();
    for (name, table) in &tables {
        bytes.extend(name.iter().copied().chain([0; 4]));
        bytes.extend((end as u32).to_be_bytes().into_iter().chain((table.len() as u32).to_be_bytes()));
        end += table.len();
    }
    bytes.extend(tables.into_iter().flat_map(|(_, table)| table));
    bytes
}

/// A glyph of one square.
fn square() -> Vec<u8> {
    let mut glyph = Vec::new();
    put(&mut glyph, &[1, 0, 0, 500, 700, 3, 0]);
    glyph.extend([1, 1, 1, 1]);
    put(&mut glyph, &[0, 500, 0, 500_u16.wrapping_neg(), 0, 0, 700, 0]);
    glyph
}

/// A glyph composed of `times` copies of the glyph with the index `of`.
fn composite(of: u16, times: usize) -> Vec<u8> {
    let mut glyph = Vec::new();
    put(&mut glyph, &[0xffff, 0, 0, 500, 700]);
    for time in 1..=times {
        let more = if time < times { 0x20 } else { 0 };
        put(&mut glyph, &[0x2 | more, of, 0]);
    }
    glyph
}

/// A layout table with `steps` steps, each of which replaces the glyph with the index `glyph` by `times` copies of
/// itself.
fn multiplying(steps: u16, glyph: u16, times: u16) -> Vec<u8> {
    let mut table = Vec::new();
    let features = 10 + 20;
    let lookups = features + 2 + 6 + 4 + 2 * steps;
    put(&mut table, &[1, 0, 10, features, lookups, 1]);
    table.extend(b"DFLT");
    put(&mut table, &[8, 4, 0, 0, 0xffff, 1, 0, 1]);
    table.extend(b"ccmp");
    put(&mut table, &[8, 0, steps]);
    put(&mut table, &(0..steps).collect::<Vec<u16>>());
    put(&mut table, &[steps]);
    put(&mut table, &(0..steps).map(|step| 2 + 2 * steps + step * (24 + 2 * times)).collect::<Vec<u16>>());
    for _ in 0..steps {
        put(&mut table, &[2, 0, 1, 8, 1, 8, 1, 14, 1, 1, glyph, times]);
        put(&mut table, &vec![glyph; times as usize]);
    }
    table
}

/// Draws a text with a font. Returns the number of rings of its areas, or the code of the error. Panics if that takes
/// longer than `LONGEST`.
fn outcome(bytes: &[u8], words: &str) -> Result<usize, &'static str> {
    let start = Instant::now();
    let drawn = Font::read(bytes).and_then(|font| draw(&TextSettings::new(words, &font)));
    assert!(start.elapsed() < LONGEST, "{:?}", start.elapsed());
    let made = drawn.map_err(|error| error.code)?;
    Ok(made.drawing.parts.iter().flat_map(|part| &part.areas).map(|area| area.rings.len()).sum())
}

#[test]
fn a_plain_font_of_this_kind_is_drawn() {
    assert_eq!(outcome(&font(&[square(), square()], None), "AA"), Ok(2));
    assert_eq!(outcome(&font(&[square(), square(), composite(1, 3)], None), "A"), Ok(3));
    assert_eq!(outcome(&font(&[square(), square()], Some(multiplying(2, 1, 3))), "A"), Ok(9));
}

#[test]
fn glyphs_of_glyphs_of_glyphs_are_refused() {
    for (levels, times) in [(8, 10), (30, 2)] {
        let glyphs =
            [square(), square()].into_iter().chain((1..=levels).map(|level| composite(level, times)));
        assert_eq!(outcome(&font(&glyphs.collect::<Vec<_>>(), None), "A"), Err("font-empty"));
    }
}

#[test]
fn a_glyph_that_contains_itself_is_refused() {
    assert_eq!(outcome(&font(&[square(), composite(1, 2)], None), "A"), Err("font-empty"));
}

#[test]
fn letters_that_multiply_are_bounded() {
    let bomb = font(&[square(), square()], Some(multiplying(9, 1, 100)));
    let rings = outcome(&bomb, &"A".repeat(2_000)).unwrap_or(0);
    assert!(rings <= 2_000_000, "{rings}");
}
