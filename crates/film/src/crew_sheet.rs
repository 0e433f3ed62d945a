//! Prints what the crew needs on paper: where robots start, what happens when, and what to check.

use lightbots_base::Vec2;
use lightbots_lighting::{FrameTimes, PlannedShow};
use lightbots_show::{CuePlace, Show, clock_label};

use crate::pdf_page::{MARGIN, Mark, PAGE, document};
use crate::words::{numbered, short};

/// Height of a row of a table, points.
const ROW: f32 = 14.0;
/// Font size of tables and text, points.
const LETTERS: f32 = 9.0;
/// Number of robots in a row of the table of starting places.
const COLUMNS: usize = 3;
/// Largest height of the map of starting places, points.
const MAP_HEIGHT: f32 = 400.0;
/// Largest number of robots with which the map has their names. With more robots, it has no names at all.
const NAMED_MAX: usize = 200;

/// Checks before a show. docs/operations.md has the details.
const CHECKLIST: [&str; 14] = [
    "Floor swept; size measured and the same as above; edges marked",
    "No-go areas free of cables and marked; audience behind its line",
    "Batteries charged; fleet table shows no robot below the show's need",
    "Robots on their starting places, wheels free",
    "Every robot is in the fleet table under its own name",
    "Places in the table agree with the floor (wizard of the live page)",
    "Preflight passed; robots that it names were looked at",
    "Light of the hall dimmed: colours seen from the last row",
    "Music heard from the last row; offset set by ear",
    "Rehearsal of this show: no contact",
    "The one with the Stop key is named, sees the floor and knows the key",
    "Spare robots and a charger within reach",
    "Projector shows the audience view, not the controls",
    "First run of a new show at 50 % speed",
];

/// Returns the sheet for the crew as PDF. `starts` are the starting places, stage metres. `names` are the names of the
/// robots that belong on these places, in the same order; `None`: any robot.
pub fn crew_sheet(
    show: &Show,
    planned: &PlannedShow<'_>,
    starts: &[Vec2],
    names: &[Option<String>],
) -> Vec<u8> {
    let title = if show.name.trim().is_empty() { "A show".to_owned() } else { short(&show.name, 60) };
    let name = |robot: usize| match names.get(robot) {
        Some(Some(name)) => short(name, 14),
        _ => (robot + 1).to_string(),
    };
    let takes_any = (0..starts.len()).any(|robot| names.get(robot).is_none_or(Option::is_none));
    let names: Vec<String> = (0..starts.len()).map(name).collect();
    let mut sheet = Sheet::default();
    sheet.heading(&title, 20.0);
    sheet.text(&facts(show, planned));
    sheet.heading("Starting places", 13.0);
    if takes_any {
        sheet.text("A place with a number takes any robot that no other place names.");
    }
    map(&mut sheet, show, starts, &names);
    starting_places(&mut sheet, starts, &names);
    sheet.heading("Frames and cues", 13.0);
    cue_list(&mut sheet, show, planned);
    sheet.heading("Checklist", 13.0);
    for line in CHECKLIST {
        sheet.checked(line);
    }
    document(&title, &sheet.pages)
}

/// Pages that are filled from top to bottom.
struct Sheet {
    pages: Vec<Vec<Mark>>,
    /// Distance of the next line from the top of the last page, points.
    y: f32,
}

impl Default for Sheet {
    fn default() -> Self {
        Self { pages: vec![Vec::new()], y: MARGIN }
    }
}

impl Sheet {
    /// Begins a new page if something of the height `height`, in points, does not fit on the current page.
    fn room(&mut self, height: f32) {
        if self.y + height > PAGE.1 - MARGIN {
            self.pages.push(Vec::new());
            self.y = MARGIN;
        }
    }

    fn put(&mut self, mark: Mark) {
        if let Some(page) = self.pages.last_mut() {
            page.push(mark);
        }
    }

    fn words(&mut self, x: f32, size: f32, words: &str) {
        let mark = Mark::Text { x, y: self.y + size, size, grey: 0, words: words.to_owned() };
        self.put(mark);
    }

    fn heading(&mut self, words: &str, size: f32) {
        self.room(size + 40.0);
        self.y += 10.0;
        self.words(MARGIN, size, words);
        self.y += size + 8.0;
    }

    fn text(&mut self, words: &str) {
        self.room(ROW);
        self.words(MARGIN, LETTERS, words);
        self.y += ROW;
    }

    /// Writes a row of a table. Each text has the distance from the left margin at which it begins, points.
    fn row(&mut self, columns: &[(f32, String)]) {
        self.room(ROW);
        for (x, words) in columns {
            self.words(MARGIN + x, LETTERS, words);
        }
        self.y += ROW;
    }

    fn rule(&mut self) {
        let y = self.y - 1.0;
        self.put(Mark::Line { from: (MARGIN, y), to: (PAGE.0 - MARGIN, y), grey: 150 });
    }

    fn checked(&mut self, words: &str) {
        self.room(ROW + 6.0);
        let y = self.y + 1.0;
        self.put(Mark::Frame { x: MARGIN, y, width: 9.0, height: 9.0, grey: 0 });
        self.words(MARGIN + 18.0, LETTERS + 1.0, words);
        self.y += ROW + 6.0;
    }
}

fn facts(show: &Show, planned: &PlannedShow<'_>) -> String {
    let stage = &show.stage;
    let music =
        show.music.as_deref().map_or(String::new(), |music| format!("   Music: {}", short(music, 40)));
    format!(
        "{} robots   {} frames   {} from the first movement to the end   Floor: {} x {} m{music}",
        planned.robots(),
        show.frames.len(),
        clock_label(planned.duration_s()),
        stage.width_m,
        stage.depth_m,
    )
}

/// Draws the floor and the starting places from above, with the front edge at the bottom.
fn map(sheet: &mut Sheet, show: &Show, starts: &[Vec2], names: &[String]) {
    let (width_m, depth_m) = (show.stage.width_m as f32, show.stage.depth_m as f32);
    let per_m = ((PAGE.0 - 2.0 * MARGIN) / width_m).min(MAP_HEIGHT / depth_m);
    let (width, height) = (width_m * per_m, depth_m * per_m);
    sheet.room(height + 24.0);
    let (left, top) = (MARGIN, sheet.y);
    sheet.put(Mark::Frame { x: left, y: top, width, height, grey: 120 });
    let radius = (show.stage.limits.radius_m as f32 * per_m).max(1.2);
    for (start, name) in starts.iter().zip(names) {
        let x = left + width / 2.0 + start.x as f32 * per_m;
        let y = top + height / 2.0 - start.y as f32 * per_m;
        sheet.put(Mark::Disc { x, y, radius, grey: 90, is_filled: false });
        if starts.len() <= NAMED_MAX {
            let size = (1.1 * radius).clamp(3.0, 7.0);
            let x = x - 0.27 * size * name.chars().count() as f32;
            sheet.put(Mark::Text { x, y: y + 0.35 * size, size, grey: 0, words: name.clone() });
        }
    }
    sheet.y = top + height + 4.0;
    sheet.text("Front edge: the audience is on this side. Places are metres from the middle of the floor, x to the right, y away from the audience.");
    sheet.y += 6.0;
}

fn starting_places(sheet: &mut Sheet, starts: &[Vec2], names: &[String]) {
    let column = (PAGE.0 - 2.0 * MARGIN) / COLUMNS as f32;
    let cells = |column_of: &dyn Fn(usize) -> [String; 3]| -> Vec<(f32, String)> {
        let at = |nth: usize| {
            let x = column * nth as f32;
            let [name, across, along] = column_of(nth);
            [(x, name), (x + 76.0, across), (x + 116.0, along)]
        };
        (0..COLUMNS).flat_map(at).collect()
    };
    sheet.row(&cells(&|_| ["Robot".into(), "x, m".into(), "y, m".into()]));
    sheet.rule();
    for first in (0..starts.len()).step_by(COLUMNS) {
        let cell = |nth: usize| match starts.get(first + nth) {
            Some(start) => [names[first + nth].clone(), format!("{:.3}", start.x), format!("{:.3}", start.y)],
            None => [const { String::new() }; 3],
        };
        sheet.row(&cells(&cell));
    }
}

fn cue_list(sheet: &mut Sheet, show: &Show, planned: &PlannedShow<'_>) {
    let columns = |words: [String; 5]| -> Vec<(f32, String)> {
        [0.0, 190.0, 250.0, 310.0, 370.0].into_iter().zip(words).collect()
    };
    sheet.row(&columns(["Frame", "Drive", "Stands at", "For, s", "Then"].map(String::from)));
    sheet.rule();
    for (index, times) in planned.times().iter().enumerate() {
        let frame = &show.frames[index];
        sheet.row(&columns([
            numbered(index, &frame.name, 34),
            format!("{:.1} s", times.air_s - times.drive_s),
            clock_label(planned.first_drive_s() + times.air_s),
            format!("{:.1}", frame.air_time_s),
            then(show, index, times),
        ]));
    }
}

/// Returns what the show does at the end of a frame, in words: wait for GO or repeat frames until GO. Empty: it goes on.
fn then(show: &Show, index: usize, times: &FrameTimes) -> String {
    let id = show.frames[index].id.as_deref();
    let cue = show.cues.iter().find(|cue| match &cue.at {
        CuePlace::Frame(frame) => Some(frame.as_str()) == id,
        CuePlace::Seconds(at_s) => (times.drive_s..times.end_s).contains(at_s),
    });
    let Some(cue) = cue else { return String::new() };
    let name = short(&cue.name, 20);
    match &cue.loop_from {
        Some(from) => {
            let first = show.frames.iter().position(|frame| frame.id.as_ref() == Some(from));
            let first = first.map_or_else(|| from.clone(), |first| (first + 1).to_string());
            format!("repeats from {first} until GO {name}")
        }
        None => format!("waits for GO {name}"),
    }
}
