//! Reads lists of lights: a place and a colour in each line, as spreadsheets export them.

use std::str::FromStr;

use lightbots_base::{Rgb, Vec2};

use crate::error::DrawError;
use crate::settings::MAX_ROBOTS;

/// Lights at exact places. The list's author chooses the unit of length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightList {
    /// Place and colour of each light, in the order of the list.
    pub places: Vec<(Vec2, Rgb)>,
}

/// Largest file that is read, bytes: 10,000 lines of 400 bytes.
const BYTES_MAX: usize = 4_000_000;
/// Largest absolute value of a coordinate, in units of the list.
const COORDINATE_MAX: f64 = 1e6;
/// Colour of lights without one.
const WHITE: Rgb = Rgb::new(255, 255, 255);
/// Example of a correct line, for error messages.
const EXAMPLE: &str = "Write a line for each light, such as 1.5, 2.0, #ff8800.";

/// Reads the lights of a list whose lines are `x, y, colour`. The colour is a CSS colour such as `#rrggbb` or a name,
/// or three columns of red, green and blue from 0 to 255. Lights without a colour are white. Columns are separated by
/// semicolons, tabs, commas or spaces; the first line decides which. With semicolons or tabs, numbers may have decimal
/// commas. A first line may name the columns, and so change their order.
///
/// # Errors
/// A list that is empty, too long or not UTF-8, or a line that is wrong; the message names the first such line.
pub fn read(bytes: &[u8]) -> Result<LightList, DrawError> {
    if bytes.len() > BYTES_MAX {
        return Err(too_long());
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes.iter().take(error.valid_up_to()).filter(|byte| **byte == b'\n').count();
        let message = format!("Line {line} of the list is not UTF-8 text. Save the table as CSV in UTF-8.");
        DrawError::new("list-text", message)
    })?;
    let mut lines = rows(text).peekable();
    let Some((_, first)) = lines.peek() else {
        return Err(DrawError::new("list-empty", format!("The list has no lines. {EXAMPLE}")));
    };
    let separator = separator(first);
    let columns = match Columns::named(&fields(first, separator)) {
        Some(columns) => {
            lines.next();
            columns
        }
        None => Columns::default(),
    };
    let mut places = Vec::new();
    for (line, row) in lines {
        if places.len() == MAX_ROBOTS {
            return Err(too_long());
        }
        places.push(light(&fields(row, separator), columns, separator).map_err(|wrong| {
            DrawError::new("list-line", format!("Line {line} of the list: {wrong} {EXAMPLE}"))
        })?);
    }
    if places.is_empty() {
        return Err(DrawError::new(
            "list-empty",
            format!("The list has a line of names, but no lights. {EXAMPLE}"),
        ));
    }
    Ok(LightList { places })
}

/// Whether a text looks like a list: its first line names columns x and y, or has two numbers, followed by a colour or
/// nothing.
pub(crate) fn looks_like(text: &str) -> bool {
    rows(text).next().is_some_and(|(_, first)| {
        let separator = separator(first);
        let fields = fields(first, separator);
        Columns::named(&fields).is_some() || light(&fields, Columns::default(), separator).is_ok()
    })
}

fn too_long() -> DrawError {
    let message =
        format!("The list has more than {MAX_ROBOTS} lights. Shorten it or split it into several lists.");
    DrawError::new("list-too-long", message)
}

/// Lines that are neither empty nor comments, each with its line number, counted from 1. Comments begin with `#`.
fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim).enumerate();
    lines.map(|(n, line)| (n + 1, line)).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// Returns the character that separates the columns: the first of `;`, tab and `,` that occurs in the line, otherwise a
/// space.
fn separator(line: &str) -> char {
    [';', '\t', ','].into_iter().find(|separator| line.contains(*separator)).unwrap_or(' ')
}

/// Splits a line into columns. Separators within quotation marks do not split.
fn fields(line: &str, separator: char) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        if letter == '"' {
            quoted = !quoted;
        } else if letter == separator && !quoted {
            fields.push(String::new());
        } else if let Some(field) = fields.last_mut() {
            field.push(letter);
        }
    }
    let fields = fields.into_iter().map(|field| field.trim().to_owned());
    fields.filter(|field| separator != ' ' || !field.is_empty()).collect()
}

/// Indices of the columns.
#[derive(Clone, Copy)]
struct Columns {
    x: usize,
    y: usize,
    color: usize,
}

impl Default for Columns {
    fn default() -> Self {
        Self { x: 0, y: 1, color: 2 }
    }
}

impl Columns {
    /// Finds the columns by their names in a header line. `None` if the line has no columns named x and y.
    fn named(names: &[String]) -> Option<Self> {
        let find = |wanted: &[&str]| {
            names.iter().position(|name| {
                let word = name.split([' ', '(', '[', '_']).next().unwrap_or("").to_lowercase();
                wanted.contains(&word.as_str())
            })
        };
        let (x, y) = find(&["x"]).zip(find(&["y"]))?;
        let color = find(&["colour", "color", "rgb", "hex"]).or(find(&["r", "red"]));
        Some(Self { x, y, color: color.unwrap_or(names.len()) })
    }
}

/// Reads the light in the columns of one line. The error says what is wrong.
fn light(fields: &[String], columns: Columns, separator: char) -> Result<(Vec2, Rgb), String> {
    let number = |name: &str, column: usize| {
        let field = fields.get(column).map_or("", String::as_str);
        let plain =
            if separator == ';' || separator == '\t' { field.replace(',', ".") } else { field.to_owned() };
        let value = plain.parse::<f64>().map_err(|_| match field {
            "" => format!("{name} is missing."),
            _ => format!("{name} is \"{}\", which is no number.", shortened(field)),
        })?;
        if !value.is_finite() || value.abs() > COORDINATE_MAX {
            return Err(format!("{name} is {}, but at most {COORDINATE_MAX} is possible.", shortened(field)));
        }
        Ok(value)
    };
    let at = Vec2::new(number("x", columns.x)?, number("y", columns.y)?);
    Ok((at, color(fields.get(columns.color..).unwrap_or(&[]))?))
}

/// Reads the colour at the start of `fields`, which begin with the column of the colour. White if there is none.
fn color(fields: &[String]) -> Result<Rgb, String> {
    let Some(first) = fields.first().filter(|first| !first.is_empty()) else { return Ok(WHITE) };
    let wrong = |text: &str| format!("the colour \"{}\" is unknown.", shortened(text));
    let parts: Vec<&str> = first.split([',', ' ']).filter(|part| !part.is_empty()).collect();
    let channels: Vec<&str> = match parts.as_slice() {
        [_, _, _] => parts,
        _ => fields.iter().take(3).map(String::as_str).collect(),
    };
    let numbers: Vec<Option<u8>> = channels.iter().map(|part| part.parse().ok()).collect();
    if let [Some(r), Some(g), Some(b)] = numbers.as_slice() {
        return Ok(Rgb::new(*r, *g, *b));
    }
    if first.starts_with(|letter: char| letter.is_ascii_digit()) {
        return Err(format!(
            "red, green and blue must be whole numbers from 0 to 255, not \"{}\".",
            channels.join(", ")
        ));
    }
    let named = svgtypes::Color::from_str(first).map_err(|_| wrong(first))?;
    Ok(Rgb::new(named.red, named.green, named.blue))
}

/// The start of a text, for messages.
fn shortened(text: &str) -> String {
    text.chars().take(20).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::random::split_mix;

    fn places(text: &str) -> Vec<(f64, f64, u32)> {
        let list = read(text.as_bytes()).expect("it is a list");
        list.places.iter().map(|(at, color)| (at.x, at.y, color.number())).collect()
    }

    fn message(text: &str) -> String {
        read(text.as_bytes()).expect_err("it is wrong").message
    }

    #[test]
    fn separators_and_decimal_commas_are_found() {
        let expected = [(1.5, -2.0, 0xff8800), (3.0, 4.0, 0xffffff)];
        assert_eq!(places("1.5, -2.0, #ff8800\n3,4\n"), expected);
        assert_eq!(places("1,5;-2,0;#ff8800\r\n3;4;\r\n"), expected);
        assert_eq!(places("\u{feff}1,5\t-2\t#f80\n\n# a comment\n3\t4"), expected);
        assert_eq!(places("1.5 -2   #ff8800\n3 4"), expected);
    }

    #[test]
    fn a_line_of_names_orders_the_columns() {
        assert_eq!(places("x,y,colour\n1,2,red"), [(1.0, 2.0, 0xff0000)]);
        assert_eq!(places("name;color;Y (m);X (m)\na;lime;2;1"), [(1.0, 2.0, 0x00ff00)]);
        assert_eq!(places("X,Y\n1,2,red"), [(1.0, 2.0, 0xff0000)]);
        assert_eq!(places("x,y,name\n1,2,Ada"), [(1.0, 2.0, 0xffffff)]);
    }

    #[test]
    fn colours_are_codes_names_or_three_numbers() {
        for color in ["#0000ff", "#00f", "blue", "Blue", "0,0,255", "\"0, 0, 255\"", "\"rgb(0, 0, 255)\""] {
            assert_eq!(places(&format!("1,2,{color}")), [(1.0, 2.0, 0x0000ff)], "{color}");
        }
    }

    #[test]
    fn messages_name_line_fault_and_remedy() {
        assert!(
            message("1,2\n\n1,two")
                .starts_with("Line 3 of the list: y is \"two\", which is no number. Write a line")
        );
        assert!(message("1,2\n3").contains("Line 2 of the list: y is missing."));
        assert!(message("1,2,redd").contains("the colour \"redd\" is unknown"));
        assert!(message("1,2,256,0,0").contains("from 0 to 255, not \"256, 0, 0\""));
        assert!(message("1,1e300").contains("at most 1000000"));
        assert!(message("NaN,1").contains("x is NaN"));
        assert!(message("").contains("no lines"));
        assert!(message("x,y\n").contains("no lights"));
        assert!(message(&"1,2\n".repeat(MAX_ROBOTS + 1)).contains("more than 10000 lights"));
        assert!(message(&" ".repeat(BYTES_MAX + 1)).contains("more than 10000 lights"));
        assert_eq!(read(b"1,2\n\xff").expect_err("it is no text").message.get(..6), Some("Line 2"));
        assert_eq!(places(&"1,2\n".repeat(MAX_ROBOTS)).len(), MAX_ROBOTS);
    }

    #[test]
    fn damaged_lists_are_read_or_refused() {
        let whole = b"x;y;colour\n1,5;2;#ff0000\n3;4;\"1,2,3\"\n5;6;blue\n";
        let mut state = 25;
        let mut below = |count: usize| (split_mix(&mut state) % count as u64) as usize;
        for _ in 0..2_000 {
            let mut bytes = whole[..below(whole.len() + 1)].to_vec();
            for _ in 0..below(4).min(bytes.len()) {
                let at = below(bytes.len());
                bytes[at] = below(256) as u8;
            }
            if let Ok(list) = read(&bytes) {
                assert!(list.places.iter().all(|(at, _)| at.is_finite()));
            }
        }
    }
}
