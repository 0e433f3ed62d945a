//! Skybrush's tables -> a show of ours.

use std::collections::BTreeSet;

use lightbots_show::{MAX_PIXELS, excerpt};

use super::{HEAD, is_table};
use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::text;
use crate::timed::light::{CodeStretch, STRETCHES_MAX, TimedLight};
use crate::timed::path::{PIECES_MAX, PathReader};
use crate::timed::{TimedRobot, TimedShow, import};
use crate::zip_files::{damaged, unpack};

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let mut tables: Vec<(String, Vec<u8>)> = Vec::new();
    unpack(bytes, MAX_PIXELS + 1, |name, content| {
        if is_table(&name) {
            tables.push((name, content));
        }
        Ok(())
    })?;
    tables.sort_by_cached_key(|(name, _)| natural(name));
    let mut room = (PIECES_MAX, STRETCHES_MAX);
    let mut show = TimedShow::default();
    let mut names = BTreeSet::new();
    for (name, content) in tables {
        let robot = table(stem(&name), &content, &mut room)
            .map_err(|error| error.within(&format!("the table \"{}\"", excerpt(&name))))?;
        if !names.insert(robot.name.clone()) {
            return Err(damaged(&format!("two tables are called \"{}\"", excerpt(&robot.name))));
        }
        show.robots.push(robot);
    }
    import::loaded(&show)
}

/// The name of a robot: the file name of its table, without folders and without `.csv`.
fn stem(file: &str) -> &str {
    let name = file.rsplit('/').next().unwrap_or(file);
    &name[..name.len().saturating_sub(".csv".len())]
}

/// Sort key of a file's name without its folders. Numbers in names count as numbers: "Robot 10" comes after "Robot 9".
fn natural(name: &str) -> Vec<(u64, String)> {
    let mut parts = Vec::new();
    let mut rest = stem(name);
    while !rest.is_empty() {
        let letters = rest.find(|char: char| char.is_ascii_digit()).unwrap_or(rest.len());
        let (word, numbers) = rest.split_at(letters);
        let digits = numbers.find(|char: char| !char.is_ascii_digit()).unwrap_or(numbers.len());
        let (number, after) = numbers.split_at(digits);
        // Words and numbers take turns. A number with too many digits for 64 bits becomes the largest one.
        parts.push((0, word.to_owned()));
        let value = if number.is_empty() { 0 } else { number.parse().unwrap_or(u64::MAX) };
        parts.push((value, String::new()));
        rest = after;
    }
    parts
}

fn table(name: &str, content: &[u8], room: &mut (usize, usize)) -> Result<TimedRobot, ReadError> {
    let text = text(content)?;
    let mut lines = text.lines();
    let head = lines.next().unwrap_or_default().to_ascii_lowercase();
    if !head.starts_with("time") {
        let what = format!("the first line is not \"{HEAD}\"; write it");
        return Err(ReadError { place: Some((1, 1)), ..ReadError::whole("bad-table", what) });
    }
    let mut path = PathReader::new(&mut room.0);
    let mut light = TimedLight { is_linear: true, ..TimedLight::default() };
    for (number, line) in (2..).zip(lines) {
        if line.trim().is_empty() {
            continue;
        }
        let fail = |what: String| ReadError { place: Some((number, 1)), ..ReadError::whole("bad-row", what) };
        let (at_s, place, code) = row(line).map_err(fail)?;
        path.point(at_s, place, None).map_err(fail)?;
        if light.stretches.is_empty() {
            light.start = code;
        }
        // A fade to the same colour is a hold. Holds that follow each other become one.
        let fades = code != light.last();
        light.push(CodeStretch { end_s: at_s, to: code, fades }, &mut room.1).map_err(fail)?;
    }
    let path = path.end().map_err(|what| ReadError::whole("bad-table", what))?;
    Ok(TimedRobot { name: name.to_owned(), path, light })
}

/// Reads a row: time in seconds, place in metres, and codes of red, green and blue, 0 to 255. A row without codes is
/// white.
fn row(line: &str) -> Result<(f64, [f64; 3], [u8; 3]), String> {
    let wrong = |what: &str| format!("\"{}\": {what}; a row is {HEAD}", excerpt(line));
    let fields: Vec<&str> = line.trim_end().split(',').map(str::trim).collect();
    let metres = |field: &str| {
        let number = field.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| wrong(&format!("\"{}\" is no number", excerpt(field))))
    };
    let code = |field: &str| {
        field
            .parse::<u8>()
            .map_err(|_| wrong(&format!("\"{}\" is no whole number from 0 to 255", excerpt(field))))
    };
    let (numbers, codes) = match fields[..] {
        [t, x, y, z] | [t, x, y, z, ""] => ([t, x, y, z], [255; 3]),
        [t, x, y, z, r, g, b] | [t, x, y, z, r, g, b, ""] => ([t, x, y, z], [code(r)?, code(g)?, code(b)?]),
        _ => return Err(wrong(&format!("{} columns", fields.len()))),
    };
    let [t, x, y, z] = numbers.map(metres);
    Ok((t? / 1e3, [x?, y?, z?], codes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_by_their_numbers() {
        let mut names = ["r10.csv", "a/r9.csv", "r9b.csv", "q.csv", "r.csv", "10.csv", "9.csv"];
        names.sort_by_key(|name| natural(name));
        assert_eq!(names, ["9.csv", "10.csv", "q.csv", "r.csv", "a/r9.csv", "r9b.csv", "r10.csv"]);
    }

    #[test]
    fn rows_are_numbers_or_words_say_which_is_none() {
        assert_eq!(row("1500, 1,2.5,-3,0,10,255"), Ok((1.5, [1.0, 2.5, -3.0], [0, 10, 255])));
        assert_eq!(row("0,0,0,0"), Ok((0.0, [0.0; 3], [255; 3])));
        for (line, part) in [
            ("0,NaN,0,0,1,2,3", "\"NaN\" is no number"),
            ("0,0,0,0,1.5,2,3", "\"1.5\" is no whole number"),
            ("0,0,0,0,256,2,3", "\"256\" is no whole number"),
            ("0,0,0", "3 columns"),
            ("", "1 columns"),
        ] {
            let error = row(line).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }
}
