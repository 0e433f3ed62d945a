//! VVIZ -> a show of ours.

use lightbots_show::{Issue, MAX_PIXELS};

use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::frames::{document, missing};
use crate::json::{Json, Scalar};
use crate::limits::LONGEST_S;
use crate::timed::light::{CodeStretch, STRETCHES_MAX, TimedLight};
use crate::timed::path::{PIECES_MAX, PathReader, TimedPath};
use crate::timed::{TimedRobot, TimedShow, import};

/// Allowed numbers of steps of places, and of frames of colours, in a second.
const RATES: std::ops::RangeInclusive<f64> = 0.01..=1_000.0;
/// Codes of a robot without a light.
const WHITE: [u8; 3] = [255; 3];

pub(crate) fn read(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let (reader, _) = document(bytes, |json, _| {
        let mut reader = Reader::new(json)?;
        reader.document(json)?;
        Ok(reader)
    })?;
    let mut loaded = import::loaded(&reader.show)?;
    if reader.has_pyro {
        let what = "the file has payloads that are no lights, such as fireworks; they are left out";
        loaded.issues.push(Issue::warning("parts-left-out", what));
    }
    Ok(loaded)
}

/// Reads performances. Counts down the pieces and stretches that may still follow in the file.
struct Reader {
    show: TimedShow,
    /// Number of steps of places in a second, and number of frames of colours in a second.
    rates: [f64; 2],
    /// When the performances begin, seconds from the start of the show.
    offset_s: f64,
    pieces: usize,
    stretches: usize,
    /// Whether there are payloads other than lights.
    has_pyro: bool,
}

impl Reader {
    /// Reads rates, offset and coordinate frame, which may follow the performances in the file. Moves `json` only past
    /// white space.
    fn new(json: &mut Json<'_>) -> Result<Self, ReadError> {
        json.peek()?;
        let number = |name: &str, usual: f64| match json.ahead(name) {
            None => Ok(usual),
            Some(Scalar::Number(number)) => Ok(number),
            Some(_) => Err(json.fail("not-a-number", format!("\"{name}\" is no number; give it one"))),
        };
        let rate = |name: &str, usual: f64| {
            let rate = number(name, usual)?;
            let what = || format!("\"{name}\" is {rate}; it must be 0.01 to 1000 frames a second");
            if RATES.contains(&rate) { Ok(rate) } else { Err(json.fail("bad-rate", what())) }
        };
        let rates = [rate("defaultPositionRate", 1.0)?, rate("defaultColorRate", 1.0)?];
        let offset_s = number("timeOffsetSecs", 0.0)?;
        if !(0.0..=LONGEST_S).contains(&offset_s) {
            let what = format!("\"timeOffsetSecs\" is {offset_s}; it must be 0 to a day");
            return Err(json.fail("bad-offset", what));
        }
        if let Some(Scalar::Text(frame)) = json.ahead("coordinateFrame")
            && frame != "ogl"
        {
            let what = "its coordinate frame is not \"ogl\" (x right, y up, z forward); export it as that";
            return Err(json.fail("unknown-frame", what));
        }
        Ok(Self {
            show: TimedShow::default(),
            rates,
            offset_s,
            pieces: PIECES_MAX,
            stretches: STRETCHES_MAX,
            has_pyro: false,
        })
    }

    fn document(&mut self, json: &mut Json<'_>) -> Result<(), ReadError> {
        let mut has_version = false;
        json.object(|json, key| {
            match key {
                "version" => has_version = version(json)?,
                "performanceName" => self.show.name = json.text("the name of the performance")?.into_owned(),
                "performances" => self.performances(json)?,
                _ => json.skip()?,
            }
            Ok(())
        })?;
        if has_version { Ok(()) } else { Err(missing(json, "the version of the file")) }
    }

    fn performances(&mut self, json: &mut Json<'_>) -> Result<(), ReadError> {
        json.list(|json, index| {
            if index >= MAX_PIXELS {
                let what = format!("more than {MAX_PIXELS} performances; take some away");
                return Err(json.fail("too-many-robots", what));
            }
            let robot = self.performance(json).map_err(|error| error.of_nth("performance", index))?;
            self.show.robots.push(robot);
            Ok(())
        })
    }

    fn performance(&mut self, json: &mut Json<'_>) -> Result<TimedRobot, ReadError> {
        let (mut path, mut light) = (None, None);
        json.object(|json, key| {
            match key {
                "agentDescription" => path = Some(self.agent(json)?),
                "payloadDescription" => {
                    json.list(|json, _| {
                        let payload = self.payload(json)?;
                        light = light.take().or(payload);
                        Ok(())
                    })?;
                }
                _ => json.skip()?,
            }
            Ok(())
        })?;
        let path = path.ok_or_else(|| missing(json, "the agentDescription"))?;
        Ok(TimedRobot { name: String::new(), path, light: light.unwrap_or(TimedLight::constant(WHITE)) })
    }

    fn agent(&mut self, json: &mut Json<'_>) -> Result<TimedPath, ReadError> {
        json.peek()?;
        let mut at = [0.0; 3];
        for (axis, name) in ["homeX", "homeY", "homeZ"].into_iter().enumerate() {
            match json.ahead(name) {
                Some(Scalar::Number(metres)) => at[axis] = metres,
                _ => return Err(missing(json, &format!("the number \"{name}\""))),
            }
        }
        let (offset_s, step_s) = (self.offset_s, 1.0 / self.rates[0]);
        let mut path = PathReader::new(&mut self.pieces);
        path.point(0.0, floor(at), None).map_err(|what| json.fail("bad-path", what))?;
        path.point(offset_s, floor(at), None).map_err(|what| json.fail("bad-path", what))?;
        let mut at_s = offset_s;
        json.object(|json, key| match key {
            "agentTraversal" => json.list(|json, _| {
                let begin = json.clone();
                let (by, seconds) = step(json)?;
                at_s += seconds.unwrap_or(step_s);
                (0..3).for_each(|axis| at[axis] += by[axis]);
                path.point(at_s, floor(at), None).map_err(|what| begin.fail("bad-path", what))
            }),
            _ => json.skip(),
        })?;
        path.end().map_err(|what| json.fail("bad-path", what))
    }

    /// Reads the light of a payload; `None` if the payload is no light.
    fn payload(&mut self, json: &mut Json<'_>) -> Result<Option<TimedLight>, ReadError> {
        json.peek()?;
        if json.ahead("type") != Some(Scalar::Text("Light".into())) {
            self.has_pyro = true;
            return json.skip().map(|()| None);
        }
        let mut light = TimedLight { is_linear: false, ..TimedLight::default() };
        let (mut frames, offset_s, rate) = (0.0, self.offset_s, self.rates[1]);
        let room = &mut self.stretches;
        if offset_s > 0.0 {
            let dark = CodeStretch { end_s: offset_s, to: [0; 3], fades: false };
            light.push(dark, room).map_err(|what| json.fail("bad-light", what))?;
        }
        json.object(|json, key| match key {
            "payloadActions" => json.list(|json, _| {
                let begin = json.clone();
                let (to, lasts) = action(json)?;
                frames += lasts;
                let stretch = CodeStretch { end_s: offset_s + frames / rate, to, fades: false };
                light.push(stretch, room).map_err(|what| begin.fail("bad-light", what))
            }),
            _ => json.skip(),
        })?;
        Ok(Some(light))
    }
}

fn version(json: &mut Json<'_>) -> Result<bool, ReadError> {
    json.peek()?;
    let before = json.clone();
    let is_known = match json.scalar()? {
        Scalar::Text(version) => version.starts_with("1."),
        Scalar::Number(version) => version == 1.0,
        _ => false,
    };
    let what = "the file has another version than 1.0 of VVIZ; export it as that";
    if is_known { Ok(true) } else { Err(before.fail("unknown-version", what)) }
}

/// Converts a place of VVIZ, `[x, up, forward]`, into `[x, y, height]` of the stage, metres.
fn floor([x, up, forward]: [f64; 3]) -> [f64; 3] {
    [x, forward, up]
}

/// Reads a step: displacement along x, y and z of VVIZ in metres, and duration in seconds; `None` if not stated.
fn step(json: &mut Json<'_>) -> Result<([f64; 3], Option<f64>), ReadError> {
    let (mut by, mut seconds) = ([0.0; 3], None);
    json.object(|json, key| {
        match key {
            "dx" => by[0] = json.number(key)?,
            "dy" => by[1] = json.number(key)?,
            "dz" => by[2] = json.number(key)?,
            "dt" => seconds = Some(json.number(key)?),
            _ => json.skip()?,
        }
        Ok(())
    })?;
    Ok((by, seconds))
}

/// Reads an action: codes of red, green and blue, and the number of colour frames for which they are held, 1 if not
/// stated.
fn action(json: &mut Json<'_>) -> Result<([u8; 3], f64), ReadError> {
    let (mut code, mut frames) = ([0; 3], 1.0);
    json.object(|json, key| {
        json.peek()?;
        let before = json.clone();
        let channel = match key {
            "r" => 0,
            "g" => 1,
            "b" => 2,
            "frames" => {
                frames = json.number(key)?;
                let what = format!("a colour lasts {frames} frames; it must last 0 or more");
                return if frames >= 0.0 { Ok(()) } else { Err(before.fail("bad-light", what)) };
            }
            _ => return json.skip(),
        };
        let value = json.number(key)?;
        if !(0.0..=255.0).contains(&value) {
            let what = format!("\"{key}\" is {value}; it must be 0 to 255");
            return Err(before.fail("bad-color", what));
        }
        code[channel] = value.round() as u8;
        Ok(())
    })?;
    Ok((code, frames))
}
