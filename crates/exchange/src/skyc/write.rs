//! A planned show as Skybrush's compiled show.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lightbots_base::{Piece, Vec2};
use lightbots_plan::{Path, ShowPlan};
use lightbots_show::{Issue, Issues, Show};

use super::light_program::program;
use super::{DOCUMENT, DRONES_MAX, media};
use crate::format::Written;
use crate::json::text::{exact, lines, quoted};
use crate::limits::MAX_BYTES;
use crate::timed::export::{ExportedRobot, ExportedShow, linear, sampled_note, written};
use crate::timed::fit::fitted;
use crate::zip_files::pack;

/// Bytes reserved for the document without its drones: the names of show and music, and fixed text.
const HEAD_MAX: usize = 8 << 10;
/// Largest distance of a piece's control points from those of a straight line at which it is written as a line, metres.
const STRAIGHT_M: f64 = 1e-9;

pub(crate) fn encode(show: &Show, plan: Option<&ShowPlan>) -> Written {
    written(show, plan, |exported| archive(show, exported))
}

fn archive(show: &Show, exported: &ExportedShow) -> Result<(Vec<u8>, Issues), Issue> {
    let robots = exported.robots.len();
    if robots > DRONES_MAX {
        let what = format!("Skybrush reads at most {DRONES_MAX} robots, and the show has {robots}");
        return Err(Issue::error("too-many-robots", what));
    }
    let mut issues = vec![sampled_note(
        "lights are written each 20 ms in linear light of eight bits, within one step; the darkest colours become black",
    )];
    let mut music = media::written(show, exported.first_s).unwrap_or_else(|lost| {
        issues.push(lost);
        None
    });
    let drones = drones(exported);
    if drones.len() + HEAD_MAX > MAX_BYTES {
        let what =
            format!("the show has more than {} MiB for Skybrush; export a part of it", MAX_BYTES >> 20);
        return Err(Issue::error("too-big", what));
    }
    if music.as_ref().is_some_and(|music| drones.len() + HEAD_MAX + music.content.len() > MAX_BYTES) {
        let what =
            format!("with its music the file would have more than {} MiB: it is left out", MAX_BYTES >> 20);
        issues.push(Issue::warning("music-left-out", what));
        music = None;
    }
    let document = text(show, music.as_ref().map_or("", |music| &music.words), &drones);
    let mut files = vec![(DOCUMENT.to_owned(), document.as_bytes())];
    files.extend(music.iter().map(|music| (music.file.clone(), &*music.content)));
    Ok((pack(files)?, issues))
}

fn text(show: &Show, media: &str, drones: &str) -> String {
    format!(
        "{{\"version\":1,{media}\"meta\":{{\"title\":{}}},\"settings\":{{}},\"environment\":{{\"type\":\"indoor\"}},\
         \"swarm\":{{\"drones\":{drones}}}}}\n",
        quoted(&show.name)
    )
}

fn drones(exported: &ExportedShow) -> String {
    lines(exported.robots.iter().map(drone), "")
}

fn drone(robot: &ExportedRobot) -> String {
    let (start, end) = (robot.path.start, robot.path.as_ref().end());
    let lights = STANDARD.encode(program(&fitted(&linear(&robot.colours))));
    format!(
        "{{\"type\":\"generic\",\"settings\":{{\"name\":{},\"home\":{},\"landAt\":{},\"trajectory\":{},\
         \"lights\":{{\"version\":1,\"data\":\"{lights}\"}}}}}}",
        quoted(&robot.name),
        place(start),
        place(end),
        trajectory(&robot.path)
    )
}

fn trajectory(path: &Path) -> String {
    let mut points = vec![format!("[0,{},[]]", place(path.start))];
    for (from, begin, piece) in path.as_ref().timed() {
        let end_s = exact((begin + piece.duration).as_secs());
        let controls = if is_line(from, piece) {
            String::new()
        } else {
            format!("{},{}", place(piece.c1), place(piece.c2))
        };
        points.push(format!("[{end_s},{},[{controls}]]", place(piece.end)));
    }
    format!(
        "{{\"version\":1,\"points\":[{}],\"takeoffTime\":0,\"landingTime\":{}}}",
        points.join(","),
        exact(path.as_ref().duration().as_secs())
    )
}

/// Whether a piece that starts at `from` is a straight line at constant speed.
fn is_line(from: Vec2, piece: &Piece) -> bool {
    let line = Piece::straight(from, piece.end, piece.duration);
    line.c1.distance(piece.c1) <= STRAIGHT_M && line.c2.distance(piece.c2) <= STRAIGHT_M
}

/// A place on the floor, with height 0: the format has no places without a height.
fn place(at: Vec2) -> String {
    format!("[{},{},0]", exact(at.x), exact(at.y))
}
