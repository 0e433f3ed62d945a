//! Draws thirty sources with five numbers of robots each, and compares figures with simple placing methods:
//! `cargo run --release -p lightbots-make --example sheet -- PICTURE.png [FOLDER]`. With FOLDER, shows of all thirty
//! frames for 30, 100 and 500 robots are written there, for rehearsals.
#![allow(clippy::print_stdout)]

mod paint;
mod pictures;
mod sources;

use std::error::Error;
use std::path::Path;

use lightbots_base::Vec2;
use lightbots_draw::{DrawingPart, Figures, PictureFloor, Quality, figures, rivals};
use lightbots_make::{MadeFrame, Material, make_frame, material, picture_floor};
use lightbots_show::{Frame, Show, Stage};

use crate::sources::Source;

/// Numbers of robots with which each source is drawn.
const COUNTS: [usize; 5] = [12, 30, 100, 500, 2_000];

/// Numbers of robots for which shows are written.
const PLAYED: [usize; 3] = [30, 100, 500];

/// Side of the floor, metres: room for 2,000 robots.
const FLOOR_M: f64 = 14.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let picture = arguments.next().ok_or("name the picture to write")?;
    let folder = arguments.next();
    let sources = sources::all()?;
    let mut table = Table::default();
    let mut sheet = paint::Sheet::new(sources.len(), COUNTS.len());
    for (row, source) in sources.iter().enumerate() {
        for (column, robots) in COUNTS.into_iter().enumerate() {
            let floor = PictureFloor::new(FLOOR_M, FLOOR_M, 0.05);
            match made(source, &floor, robots) {
                Ok(made) => {
                    sheet.draw(row, column, &made);
                    table.add(source, robots, &made);
                }
                Err(message) => println!("{} with {robots} robots: {message}", source.name),
            }
        }
    }
    table.print();
    sheet.write(Path::new(&picture))?;
    if let Some(folder) = folder {
        for robots in PLAYED {
            write_show(&sources, robots, Path::new(&folder))?;
        }
    }
    Ok(())
}

fn frame_of(source: &Source) -> Frame {
    Frame {
        name: source.name.into(),
        air_time_s: 1.0,
        sources: vec![source.recipe.source()],
        ..Frame::default()
    }
}

fn made(source: &Source, floor: &PictureFloor, robots: usize) -> Result<MadeFrame, String> {
    make_frame(&frame_of(source), source.asset.as_deref(), floor, robots, Quality::Full, &[])
        .map_err(|error| error.message)
}

/// Figures of all sources, by placing method and number of robots.
#[derive(Default)]
struct Table {
    rows: Vec<(String, usize, Figures)>,
}

impl Table {
    fn add(&mut self, source: &Source, robots: usize, made: &MadeFrame) {
        let Ok(Material::Drawing { made: drawn, .. }) = material(&source.recipe, source.asset.as_deref())
        else {
            return;
        };
        let Some((low, high)) = drawn.drawing.bounds() else { return };
        let part = DrawingPart {
            areas: drawn.drawing.parts.iter().flat_map(|part| part.areas.clone()).collect(),
            strokes: drawn.drawing.parts.iter().flat_map(|part| part.strokes.clone()).collect(),
            raster: drawn.drawing.parts.first().and_then(|part| part.raster.clone()),
            ..DrawingPart::default()
        };
        // Figures describe areas or lines. In a drawing with both, robots on lines would count as outside the areas.
        if !part.areas.is_empty() && !part.strokes.is_empty() {
            return;
        }
        let scale = made.size_m / (high.x - low.x).max(high.y - low.y);
        let places: Vec<Vec2> =
            made.frame.pixels.iter().map(|pixel| pixel.at * (1.0 / scale) + low.lerp(high, 0.5)).collect();
        let read = made.readability.map_or(1.0, |read| read.correlation);
        if let Some(own) = figures(&part, &places) {
            println!(
                "{:14} {robots:5}: CV {:.3} closest {:.2} Hausdorff {:.2} and {:.2} covered {:.2} corners {:.2} read {read:.2}",
                source.name,
                own.variation,
                own.closest,
                own.farthest_point,
                own.farthest_place,
                own.covered,
                own.corners
            );
            self.rows.push(("LightBots".into(), robots, own));
        }
        for (name, places) in rivals(&part, robots, 1) {
            if let Some(figures) = figures(&part, &places) {
                self.rows.push((name.into(), robots, figures));
            }
        }
    }

    fn print(&self) {
        println!(
            "\n| way | robots | CV | closest | Hausdorff out / in | covered | corners |\n|---|---|---|---|---|---|---|"
        );
        for way in ["random", "grid", "farthest point", "LightBots"] {
            for robots in COUNTS {
                let rows: Vec<&Figures> = self
                    .rows
                    .iter()
                    .filter(|row| row.0 == way && row.1 == robots)
                    .map(|row| &row.2)
                    .collect();
                let mean =
                    |of: fn(&Figures) -> f64| rows.iter().map(|row| of(row)).sum::<f64>() / rows.len() as f64;
                println!(
                    "| {way} | {robots} | {:.3} | {:.2} | {:.2} / {:.2} | {:.2} | {:.2} |",
                    mean(|row| row.variation),
                    mean(|row| row.closest),
                    mean(|row| row.farthest_point),
                    mean(|row| row.farthest_place),
                    mean(|row| row.covered),
                    mean(|row| row.corners)
                );
            }
        }
    }
}

/// Writes a show of all sources, one frame each, for this many robots.
fn write_show(sources: &[Source], robots: usize, folder: &Path) -> Result<(), Box<dyn Error>> {
    let side_m = (robots as f64).sqrt().mul_add(0.4, 1.0);
    let stage = Stage { width_m: side_m, depth_m: side_m, ..Stage::default() };
    let floor = picture_floor(&stage);
    let mut show = Show { stage, ..Show::default() };
    for source in sources {
        match made(source, &floor, robots) {
            Ok(MadeFrame { mut frame, .. }) => {
                // Sources are removed, because their files are not beside the show.
                frame.sources.clear();
                frame.pixels.iter_mut().for_each(|pixel| pixel.part = None);
                show.frames.push(frame);
            }
            Err(message) => println!("{} is not in the show of {robots} robots: {message}", source.name),
        }
    }
    std::fs::create_dir_all(folder)?;
    let name = folder.join(format!("sheet-{robots}.lightbots"));
    std::fs::write(name, lightbots_exchange::LIGHTBOTS.write(&show, None).bytes)?;
    Ok(())
}
