//! Skybrush's compiled show -> a show of ours. Parts of a drone are in the document or in files of their own.

use std::collections::BTreeMap;

use lightbots_show::{Issue, MAX_PIXELS, excerpt};

use super::encoded::encoded;
use super::reference::file_name;
use super::{DOCUMENT, light_program, media};
use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::frames::missing;
use crate::json::{Json, Scalar, text};
use crate::limits::MAX_BYTES;
use crate::timed::light::{STRETCHES_MAX, TimedLight};
use crate::timed::path::{PIECES_MAX, PathReader, TimedPath};
use crate::timed::{TimedRobot, TimedShow, import};
use crate::zip_files::{damaged, unpack};

/// Largest number of files in an archive: the document, and up to three per drone.
const ENTRIES_MAX: usize = 1 + 3 * MAX_PIXELS;
/// Largest number of bytes of all files to which drones refer. A file counts once for each drone that refers to it,
/// because it is read again for each.
const REFERRED_MAX: usize = 4 * MAX_BYTES;
/// Codes of a drone without lights.
const WHITE: [u8; 3] = [255; 3];

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let mut files = BTreeMap::new();
    unpack(bytes, ENTRIES_MAX, |name, content| match files.insert(name, content) {
        None => Ok(()),
        Some(_) => Err(damaged("a file is there twice")),
    })?;
    let document = files.remove(DOCUMENT).unwrap_or_default();
    let mut reader = Reader {
        files,
        pieces: PIECES_MAX,
        stretches: STRETCHES_MAX,
        referred: REFERRED_MAX,
        unused: Vec::new(),
    };
    let show = reader.document(&document)?;
    // Frees the memory of the text for the show.
    drop((document, std::mem::take(&mut reader.files)));
    let mut loaded = import::loaded(&show)?;
    if !reader.unused.is_empty() {
        let what = format!(
            "parts of the file are for flying or for other media and are left out: {}",
            reader.unused.join(", ")
        );
        loaded.issues.push(Issue::warning("parts-left-out", what));
    }
    Ok(loaded)
}

/// Reads drones. Counts down the pieces, stretches and bytes that may still follow in the file.
struct Reader {
    /// The files of the archive besides the document, by name.
    files: BTreeMap<String, Vec<u8>>,
    pieces: usize,
    stretches: usize,
    /// Number of bytes in files to which drones may still refer; [`REFERRED_MAX`] at first.
    referred: usize,
    /// Names of parts that are left out, such as `pyro`.
    unused: Vec<&'static str>,
}

/// The parts of a drone that are read.
#[derive(Default)]
struct Drone {
    name: String,
    path: Option<TimedPath>,
    /// Bytes of the drone's light program; `None` if it has no lights.
    lights: Option<Vec<u8>>,
}

impl Reader {
    fn document(&mut self, document: &[u8]) -> Result<TimedShow, ReadError> {
        let mut json = Json::new(text(document).map_err(|error| error.within(DOCUMENT))?);
        let show = self.show(&mut json).map_err(|error| error.within(DOCUMENT))?;
        if json.is_at_end() { Ok(show) } else { Err(json.unexpected("the end of the file").within(DOCUMENT)) }
    }

    fn show(&mut self, json: &mut Json<'_>) -> Result<TimedShow, ReadError> {
        let mut show = TimedShow::default();
        let (mut has_version, mut has_swarm) = (false, false);
        json.object(|json, key| {
            match key {
                "version" => has_version = version(json, "the show")?,
                "meta" => json.object(|json, key| {
                    if key == "title"
                        && let Scalar::Text(title) = json.clone().scalar()?
                    {
                        show.name = title.into_owned();
                    }
                    json.skip()
                })?,
                "swarm" => {
                    has_swarm = true;
                    json.object(|json, key| match key {
                        "drones" => self.drones(json, &mut show.robots),
                        _ => json.skip(),
                    })?;
                }
                "media" => {
                    let media = media::read(json, &mut self.files)?;
                    show.music = media.music;
                    self.left_out(media.left_out);
                }
                _ => json.skip()?,
            }
            Ok(())
        })?;
        match (has_version, has_swarm) {
            (false, _) => Err(missing(json, "the version of the show")),
            (_, false) => Err(missing(json, "the swarm of the show")),
            _ => Ok(show),
        }
    }

    fn leave_out(&mut self, name: &'static str, json: &mut Json<'_>) -> Result<(), ReadError> {
        self.left_out(name);
        json.skip()
    }

    /// Notes that a part is left out. An empty name is ignored.
    fn left_out(&mut self, name: &'static str) {
        if !name.is_empty() && !self.unused.contains(&name) {
            self.unused.push(name);
        }
    }

    fn drones(&mut self, json: &mut Json<'_>, robots: &mut Vec<TimedRobot>) -> Result<(), ReadError> {
        json.list(|json, index| {
            if index >= MAX_PIXELS {
                let what = format!("more than {MAX_PIXELS} drones; take some away");
                return Err(json.fail("too-many-robots", what));
            }
            let before = json.clone();
            let mut drone = Drone::default();
            let read = json.object(|json, key| match key {
                "settings" => self.settings(json, &mut drone),
                _ => json.skip(),
            });
            let robot = read.and_then(|()| self.robot(drone).map_err(|what| before.fail("bad-drone", what)));
            robots.push(robot.map_err(|error| error.of_nth("drone", index))?);
            Ok(())
        })
    }

    fn settings(&mut self, json: &mut Json<'_>, drone: &mut Drone) -> Result<(), ReadError> {
        json.object(|json, key| {
            match key {
                "name" => drone.name = json.text("the name")?.into_owned(),
                "trajectory" => {
                    let pieces = &mut self.pieces;
                    let part =
                        referred(json, &self.files, &mut self.referred, &mut |json| trajectory(json, pieces));
                    drone.path = Some(part?);
                }
                "lights" => {
                    let part = referred(json, &self.files, &mut self.referred, &mut lights);
                    drone.lights = Some(part?);
                }
                "yawControl" => self.leave_out("yawControl", json)?,
                "pyro" => self.leave_out("pyro", json)?,
                _ => json.skip()?,
            }
            Ok(())
        })
    }

    fn robot(&mut self, drone: Drone) -> Result<TimedRobot, String> {
        let path = drone.path.ok_or("it has no trajectory; give it one")?;
        let light = match drone.lights {
            Some(bytes) => light_program::read(&bytes, path.end_s(), &mut self.stretches)?,
            None => TimedLight::constant(WHITE),
        };
        Ok(TimedRobot { name: drone.name, path, light })
    }
}

/// Reads the version of a part of the file. Returns `true` if it is 1. Otherwise fails with an error that names `part`.
fn version(json: &mut Json<'_>, part: &str) -> Result<bool, ReadError> {
    json.peek()?;
    let before = json.clone();
    match json.number("the version")? {
        1.0 => Ok(true),
        other => {
            let what = format!("{part} has version {other}, and version 1 is read; export it as that");
            Err(before.fail("unknown-version", what))
        }
    }
}

/// Reads a part of a drone with `read`. The part is either at the position of `json`, or in the file that is named
/// there: `{"$ref": "./drones/1/lights.json#"}`. `room` is the number of bytes of named files that may still be read.
fn referred<T>(
    json: &mut Json<'_>,
    files: &BTreeMap<String, Vec<u8>>,
    room: &mut usize,
    read: &mut dyn FnMut(&mut Json<'_>) -> Result<T, ReadError>,
) -> Result<T, ReadError> {
    json.peek()?;
    let Some(Scalar::Text(reference)) = json.ahead("$ref") else { return read(json) };
    let name = file_name(&reference);
    let Some(file) = files.get(name) else {
        let what =
            format!("it names the file \"{}\", which is not in the archive; export it again", excerpt(name));
        return Err(json.fail("missing-file", what));
    };
    *room = room.checked_sub(file.len()).ok_or_else(|| {
        let mib = REFERRED_MAX >> 20;
        json.fail(
            "too-big",
            format!("drones refer to files of more than {mib} MiB; export a part of the show"),
        )
    })?;
    json.skip()?;
    let content = text(file).map_err(|error| error.within(name))?;
    read(&mut Json::new(content)).map_err(|error| error.within(&excerpt(name)))
}

fn trajectory(json: &mut Json<'_>, pieces: &mut usize) -> Result<TimedPath, ReadError> {
    let shift_s = match json.ahead("takeoffTime") {
        Some(Scalar::Number(shift_s)) => shift_s,
        _ => 0.0,
    };
    let (mut has_version, mut path) = (false, None);
    json.object(|json, key| {
        match key {
            "version" => has_version = version(json, "its trajectory")?,
            "points" => path = Some(points(json, shift_s, pieces)?),
            _ => json.skip()?,
        }
        Ok(())
    })?;
    match path {
        Some(path) if has_version => Ok(path),
        Some(_) => Err(missing(json, "the version of its trajectory")),
        None => Err(missing(json, "the list \"points\" of its trajectory")),
    }
}

/// Reads points, each `[t, [x, y, z], controls]`, in seconds and metres. Adds `shift_s` to the times.
fn points(json: &mut Json<'_>, shift_s: f64, pieces: &mut usize) -> Result<TimedPath, ReadError> {
    let mut reader = PathReader::new(pieces);
    let mut before: Option<[f64; 3]> = None;
    json.list(|json, _| {
        json.peek()?;
        let begin = json.clone();
        let (mut at_s, mut place, mut controls) = (None, None, Vec::new());
        json.list(|json, index| {
            match index {
                0 => at_s = Some(json.number("the time of a point")?),
                1 => place = Some(triple(json)?),
                2 => controls = triples(json)?,
                _ => json.skip()?,
            }
            Ok(())
        })?;
        let (Some(at_s), Some(place)) = (at_s, place) else {
            return Err(begin.fail("bad-point", "a point has a time and a place: [t, [x, y, z], []]"));
        };
        let curve =
            cubic(&controls, before.unwrap_or(place), place).map_err(|what| begin.fail("bad-curve", what))?;
        before = Some(place);
        reader.point(at_s + shift_s, place, curve).map_err(|what| begin.fail("bad-path", what))
    })?;
    reader.end().map_err(|what| json.fail("bad-path", what))
}

/// Returns the two control points of a cubic Bézier curve between the given places. `controls` has none for a line, one
/// for a quadratic curve, or two for a cubic curve. `None` for a line; more than two are an error.
fn cubic(controls: &[[f64; 3]], from: [f64; 3], to: [f64; 3]) -> Result<Option<[[f64; 3]; 2]>, String> {
    // A quadratic curve is a cubic one whose control points are two thirds of the way to its own.
    let towards = |end: [f64; 3], via: [f64; 3]| {
        std::array::from_fn(|axis| end[axis] + (via[axis] - end[axis]) * (2.0 / 3.0))
    };
    match *controls {
        [] => Ok(None),
        [via] => Ok(Some([towards(from, via), towards(to, via)])),
        [first, second] => Ok(Some([first, second])),
        _ => Err(format!("a curve has {} control points; at most two are read", controls.len())),
    }
}

fn triples(json: &mut Json<'_>) -> Result<Vec<[f64; 3]>, ReadError> {
    let mut triples = Vec::new();
    json.list(|json, index| {
        if index >= 8 {
            return Err(
                json.fail("bad-curve", "a curve has more than 8 control points; at most two are read")
            );
        }
        triples.push(triple(json)?);
        Ok(())
    })?;
    Ok(triples)
}

/// Reads a place `[x, y, z]`, metres.
fn triple(json: &mut Json<'_>) -> Result<[f64; 3], ReadError> {
    json.peek()?;
    let begin = json.clone();
    let (mut place, mut count) = ([0.0; 3], 0);
    json.list(|json, index| {
        let number = json.number("a coordinate")?;
        if let Some(slot) = place.get_mut(index) {
            *slot = number;
        }
        count = index + 1;
        Ok(())
    })?;
    if count == 3 {
        return Ok(place);
    }
    let what =
        format!("a place has {count} coordinates; it has three in metres: [x, y, z], on the floor with z 0");
    Err(begin.fail("bad-place", what))
}

/// Reads the bytes of a light program.
fn lights(json: &mut Json<'_>) -> Result<Vec<u8>, ReadError> {
    let (mut has_version, mut data) = (false, None);
    json.object(|json, key| {
        match key {
            "version" => has_version = version(json, "its light program")?,
            "data" => {
                data = Some(encoded(json, "the data of its light program", "export it again")?);
            }
            _ => json.skip()?,
        }
        Ok(())
    })?;
    match data {
        Some(data) if has_version => Ok(data),
        Some(_) => Err(missing(json, "the version of its light program")),
        None => Err(missing(json, "the data of its light program")),
    }
}
