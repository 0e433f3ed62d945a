//! `cargo xtask webots`: writes worlds with any number of robots and installs the driver.

use crate::shell::{self, Outcome};
use std::fmt::Write as _;

/// Distance between the centres of robots in a row, metres, as in the original's world.
const SPACING_M: f64 = 0.1;
/// Distance from the wall to the centres of the first row, metres, as in the original's world.
const EDGE_M: f64 = 0.2;

/// A world to write.
struct World<'a> {
    file: &'a str,
    proto: &'a str,
    robots: usize,
    floor_m: f64,
    /// Whether the robots have no proximity sensors, whose rays cost time even if they are not read.
    blind: bool,
}

/// Writes the worlds of the repository and builds the driver. `--robots N`, `--floor METRES` and `--blind` add one more
/// world. `paces` writes nothing and plays shows in slow and pausing worlds.
pub fn run(arguments: &[String]) -> Outcome {
    if let Some(("paces", shows)) = arguments.split_first().map(|(first, rest)| (first.as_str(), rest)) {
        return paces(shows);
    }
    let wanted = wanted(arguments)?;
    for world in &STANDARD {
        write(world)?;
    }
    if let Some((robots, floor_m, blind)) = wanted {
        let file = format!("lightbots_{robots}{}.wbt", if blind { "_blind" } else { "" });
        write(&World { file: &file, proto: "LightBot", robots, floor_m, blind })?;
    }
    place_driver()
}

/// Plays shows of `shows/` with the real driver at several speeds of the simulation, and prints a table.
fn paces(shows: &[String]) -> Outcome {
    let shows = if shows.is_empty() { PACED.join(",") } else { shows.join(",") };
    shell::cargo(&["build", "--package", "lightbots-server"])?;
    let test = ["test", "--package", "lightbots-webots", "--test", "driver", "paces::", "--", "--nocapture"];
    shell::cargo_with(&test, &[("LIGHTBOTS_PACES", &shows)])
}

/// File names of the shows that `paces` plays by default. In them robots pass each other closely.
const PACED: [&str; 2] = ["hello.json", "dancers.lightbots.json"];

/// The worlds in the repository.
const STANDARD: [World<'_>; 2] = [
    World { file: "lightbots.wbt", proto: "LightBot", robots: 30, floor_m: 3.0, blind: false },
    World { file: "lightbots_elisa3.wbt", proto: "LightBotElisa3", robots: 30, floor_m: 3.0, blind: false },
];

/// Reads the number of robots, the side of the floor in metres, and `blind` of the additional world. `None` without
/// arguments. An error names an unknown option, a wrong value, or a floor that is too small.
fn wanted(arguments: &[String]) -> Outcome<Option<(usize, f64, bool)>> {
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--robots" | "--floor" => drop(rest.next()),
            "--blind" => {}
            other => return Err(format!("`cargo xtask webots` does not know '{other}'")),
        }
    }
    if arguments.is_empty() {
        return Ok(None);
    }
    let blind = arguments.iter().any(|argument| argument == "--blind");
    let value = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name)?;
        Some(arguments.get(at + 1).cloned().unwrap_or_default())
    };
    let robots = value("--robots").unwrap_or_else(|| STANDARD[0].robots.to_string());
    let robots: usize = robots.parse().map_err(|_| format!("--robots takes a number, not '{robots}'"))?;
    let side_m = match value("--floor") {
        Some(text) => text.parse().map_err(|_| format!("--floor takes metres, not '{text}'"))?,
        None => 3.0_f64.max((robots as f64 * 0.3).sqrt()),
    };
    if places(robots, side_m).len() < robots {
        return Err(format!("{robots} robots do not fit on {side_m} m x {side_m} m: take a larger --floor"));
    }
    Ok(Some((robots, side_m, blind)))
}

fn write(world: &World<'_>) -> Outcome {
    let path = shell::root().join("webots/worlds").join(world.file);
    println!("webots/worlds/{}: {} robots", world.file, world.robots);
    std::fs::write(&path, text(world)).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

/// Centres of the robots in metres, in rows from the edge where y is largest, each filled from the left. Fewer than
/// `robots` if the floor is full.
fn places(robots: usize, floor_m: f64) -> Vec<(f64, f64)> {
    let in_row = (((floor_m - 2.0 * 0.05) / SPACING_M + 1e-9).floor() as usize + 1).max(1);
    let rows = ((floor_m - 2.0 * EDGE_M) / SPACING_M).max(0.0) as usize + 1;
    (0..robots.min(in_row * rows))
        .map(|number| {
            let (row, column) = (number / in_row, number % in_row);
            let x_m = (column as f64 - (in_row - 1) as f64 / 2.0) * SPACING_M;
            (x_m, floor_m / 2.0 - EDGE_M - row as f64 * SPACING_M)
        })
        .collect()
}

fn text(world: &World<'_>) -> String {
    let mut text = format!(
        "#VRML_SIM R2025a utf8\n\nEXTERNPROTO \"../protos/{}.proto\"\n\n{}{}",
        world.proto,
        surroundings(world.floor_m),
        floor(world.floor_m)
    );
    for (number, (x_m, y_m)) in places(world.robots, world.floor_m).into_iter().enumerate() {
        let blind =
            if world.blind { "  controllerArgs [\n    \"--blind\"\n  ]\n  proximity [\n  ]\n" } else { "" };
        let _ = write!(
            text,
            "{} {{\n  translation {x_m:.3} {y_m:.3} 0\n  rotation 0 0 1 1.5708\n  name \"LightBot {}\"\n{blind}}}\n",
            world.proto,
            number + 1
        );
    }
    text
}

fn surroundings(floor_m: f64) -> String {
    let height_m = floor_m * 1.3;
    format!(
        "WorldInfo {{\n  info [\n    \"LightBots: robots that draw pictures with their lights.\"\n  ]\n  title \"LightBots\"\n  \
         basicTimeStep 16\n  contactProperties [\n    ContactProperties {{\n    }}\n  ]\n}}\n\
         Viewpoint {{\n  orientation -0.5774 0.5774 0.5774 2.0944\n  position 0 0 {height_m:.2}\n}}\n\
         Background {{\n  skyColor [\n    0.01 0.01 0.015\n  ]\n  luminosity 0.3\n}}\n\
         DirectionalLight {{\n  ambientIntensity 0.3\n  direction 0.2 0.3 -1\n  intensity 0.4\n}}\n"
    )
}

fn floor(side_m: f64) -> String {
    let half_m = side_m / 2.0;
    let mut text = format!(
        "DEF FLOOR Solid {{\n  children [\n    DEF FLOOR_SHAPE Shape {{\n      appearance PBRAppearance {{\n        \
         baseColor 0.06 0.06 0.07\n        roughness 0.9\n        metalness 0\n      }}\n      geometry Plane {{\n        \
         size {side_m} {side_m}\n      }}\n    }}\n  ]\n  name \"floor\"\n  boundingObject USE FLOOR_SHAPE\n}}\n"
    );
    let walls = [
        ("right", half_m + 0.01, 0.0),
        ("left", -half_m - 0.01, 0.0),
        ("back", 0.0, half_m + 0.01),
        ("front", 0.0, -half_m - 0.01),
    ];
    for (name, x_m, y_m) in walls {
        let (width_m, depth_m) = if y_m == 0.0 { (0.02, side_m + 0.04) } else { (side_m + 0.04, 0.02) };
        let _ = write!(
            text,
            "Solid {{\n  translation {x_m} {y_m} 0.02\n  children [\n    DEF WALL_{upper} Shape {{\n      appearance PBRAppearance {{\n        \
             baseColor 0.15 0.15 0.17\n        roughness 0.9\n        metalness 0\n      }}\n      geometry Box {{\n        \
             size {width_m} {depth_m} 0.04\n      }}\n    }}\n  ]\n  name \"{name} wall\"\n  boundingObject USE WALL_{upper}\n}}\n",
            upper = name.to_uppercase(),
        );
    }
    text
}

/// Builds the driver and copies it to the folder where Webots looks for the controller of the PROTOs.
fn place_driver() -> Outcome {
    shell::cargo(&["build", "--release", "--package", "lightbots-webots"])?;
    let name = format!("LightBotFirmware{}", std::env::consts::EXE_SUFFIX);
    let folder = shell::root().join("webots/controllers/LightBotFirmware");
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let place = folder.join(&name);
    let _ = std::fs::remove_file(&place);
    std::fs::copy(shell::target().join("release").join(&name), &place)
        .map_err(|error| format!("cannot copy the driver to {}: {error}", place.display()))?;
    println!("{}: the driver", place.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worlds_in_the_repository_are_current() {
        for world in &STANDARD {
            let found =
                std::fs::read_to_string(shell::root().join("webots/worlds").join(world.file)).unwrap();
            assert!(found == text(world), "webots/worlds/{} is stale: run `cargo xtask webots`", world.file);
        }
    }

    fn more(arguments: &[&str]) -> Outcome<Option<(usize, f64, bool)>> {
        wanted(&arguments.iter().map(|argument| (*argument).to_owned()).collect::<Vec<String>>())
    }

    #[test]
    fn a_blind_fleet_has_no_sensors() {
        assert_eq!(
            more(&["--robots", "100", "--blind"]).unwrap().map(|more| (more.0, more.2)),
            Some((100, true))
        );
        assert_eq!(more(&["--blind"]).unwrap(), Some((30, 3.0, true)));
        assert_eq!((more(&[]).unwrap(), more(&["--blnd"]).is_err()), (None, true));
        let world = World { blind: true, ..STANDARD[0] };
        assert_eq!(text(&world).matches("proximity [\n  ]").count(), 30);
        assert_eq!(text(&world).matches("\"--blind\"").count(), 30);
        assert!(!text(&STANDARD[0]).contains("proximity"));
    }

    #[test]
    fn thirty_stand_on_one_edge() {
        let places = places(30, 3.0);
        assert_eq!(places.len(), 30);
        assert!(places.iter().all(|place| place.1 == 1.3));
        assert!((places[29].0 - places[0].0 - 2.9).abs() < 1e-9);
    }
}
