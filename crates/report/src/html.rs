//! The page of a report: one file that needs no other.

use std::fmt::Write as _;

use lightbots_show::clock_label;

use crate::charts;
use crate::escape::{escaped, json_in_html};
use crate::model::{FrameFigures, RobotFigures, RunKind, ShowReport};
use crate::packed;
use crate::track::Scrub;
use crate::words::{count, millimetres, some};

/// Colours and sizes of the page: the style sheet that the browser app uses, too.
const TOKENS: &str = include_str!("../../../ui/src/style/tokens.css");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
/// Script that chooses light or dark colours by the setting of the viewer's system. It runs before the page is drawn.
const SCHEME: &str = "if (matchMedia('(prefers-color-scheme: light)').matches) \
     document.documentElement.dataset.mantineColorScheme = 'light';";

/// With more robots than this, the browser lays out rows of the robots' table only when they become visible. Laying out a
/// thousand rows takes a quarter of a second.
const ROWS_LAID_OUT: usize = 100;

/// Writes a report and its replay as an HTML page that needs no other file. Equal arguments give equal bytes.
pub fn page(report: &ShowReport, scrub: &Scrub) -> String {
    let title = if report.show.trim().is_empty() { "A show".to_owned() } else { escaped(&report.show) };
    let kind = kind(report.kind);
    let (facts, numbers) = (json_in_html(&packed::facts(scrub)), packed::numbers(scrub));
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
         content=\"width=device-width\"><title>{title} – report</title><style>{TOKENS}{STYLE}</style>\
         <script>{SCHEME}</script></head><body>\n<header data-kind=\"{}\"><span class=\"mark\"><i></i><span>LightBots\
         </span></span><span class=\"show\">{title}</span><span class=\"push mode\">{}</span></header>\n<main class=\"report\">",
        kind.0, kind.1
    );
    let tone = if report.ok { "good" } else { "look" };
    let _ = write!(page, "<h1 class=\"{tone}\">{}</h1>", escaped(&report.verdict));
    head(&mut page, report);
    figures(&mut page, report);
    page.push_str("<div class=\"grid\">");
    replay(&mut page, report, scrub);
    happened(&mut page, report);
    errors(&mut page, report);
    approaches(&mut page, report);
    robots(&mut page, &report.per_robot);
    page.push_str("</div></main>\n");
    let _ = write!(
        page,
        "<script type=\"application/json\" id=\"replay-facts\">{facts}</script>\
         <script type=\"text/plain\" id=\"replay-numbers\">{numbers}</script><script>{SCRIPT}</script></body></html>"
    );
    page
}

fn kind(kind: RunKind) -> (&'static str, &'static str) {
    match kind {
        RunKind::Rehearsal => ("rehearsal", "Rehearsal"),
        RunKind::Simulated => ("simulated", "Simulated robots"),
        RunKind::Real => ("real", "Real robots"),
    }
}

fn head(page: &mut String, report: &ShowReport) {
    let mut parts = Vec::new();
    if let Some(ms) = report.began_unix_ms {
        parts.push(format!("<time data-ms=\"{ms}\"></time>"));
    }
    parts.extend(
        report
            .notes
            .iter()
            .filter(|(name, _)| name != "began_unix_ms")
            .map(|(name, value)| format!("<span>{} {}</span>", escaped(name), escaped(value))),
    );
    if !report.is_complete {
        parts.push("<span class=\"look\">The recording was cut off, or does not replay.</span>".into());
    }
    let _ = write!(page, "<p class=\"facts quiet\">{}</p>", parts.join(""));
}

fn figures(page: &mut String, report: &ShowReport) {
    let closest = report.closest_m.map_or("–".into(), millimetres);
    let cells = [
        (format!("{} of {}", report.frames_played, report.frames), "frames shown", String::new()),
        (clock_label(report.duration_s), "duration", format!("planned {}", clock_label(report.planned_s))),
        (
            millimetres(report.tracking_error_m.median),
            "off the route, median",
            format!("at most {}", millimetres(report.tracking_error_m.max)),
        ),
        (
            closest,
            if report.contacts.is_some() { "closest, between rims" } else { "closest approach reported" },
            report.contacts.map_or(String::new(), |contacts| some(contacts as usize, "contact")),
        ),
        (
            report.brakes.all.to_string(),
            "brakes",
            report.brakes.unfounded.map_or(String::new(), |number| format!("{number} false")),
        ),
        (
            report.messages.sent.to_string(),
            "messages sent",
            report.messages.lost.map_or(String::new(), |lost| format!("{lost} lost")),
        ),
    ];
    page.push_str("<div class=\"figs\">");
    for (value, name, more) in cells {
        let _ = write!(
            page,
            "<div><div class=\"v\">{value}</div><div class=\"k\">{name}</div><div class=\"s\">{more}</div></div>"
        );
    }
    page.push_str("</div>");
}

fn replay(page: &mut String, report: &ShowReport, scrub: &Scrub) {
    let end_s = scrub.end_s.max(0.01);
    let driven = if report.has_true_places { "true place" } else { "driven, as reported" };
    let _ = write!(
        page,
        "<section class=\"box replay wide\" aria-label=\"Replay\"><div class=\"head\"><h2>Replay</h2>\
         <span class=\"legend dash push\">planned</span><span class=\"legend\">{driven}</span></div>\
         <div class=\"floor\"><canvas id=\"floor\" role=\"img\" aria-label=\"The floor at the moment of the slider\"></canvas></div>\
         <div class=\"scrub\"><button class=\"round\" id=\"play\" aria-pressed=\"false\" aria-label=\"Play the replay\">\
         <svg class=\"go\" viewBox=\"0 0 18 18\" aria-hidden=\"true\"><path d=\"M5 3l10 6-10 6z\"/></svg>\
         <svg class=\"rest\" viewBox=\"0 0 18 18\" aria-hidden=\"true\"><path d=\"M4 3h4v12H4zM10 3h4v12h-4z\"/></svg></button>\
         <span class=\"now\" id=\"now\">0:00.0</span><div class=\"strip\"><div class=\"blocks\" aria-hidden=\"true\">"
    );
    for (index, frame) in report.per_frame.iter().enumerate() {
        let until_s = report.per_frame.get(index + 1).map_or(scrub.end_s, |next| next.left_s);
        let (left, width) = (100.0 * frame.left_s / end_s, 100.0 * (until_s - frame.left_s).max(0.0) / end_s);
        let _ = write!(
            page,
            "<i style=\"left:{left:.2}%;width:{width:.2}%\" data-from=\"{}\" data-to=\"{until_s}\">{}</i>",
            frame.left_s,
            name_of(frame)
        );
    }
    let _ = write!(
        page,
        "</div><input type=\"range\" id=\"moment\" min=\"0\" max=\"{}\" step=\"0.05\" value=\"0\" aria-label=\"Moment of the show\">\
         </div><span class=\"seg\" role=\"group\" aria-label=\"Speed of the replay\"><button data-speed=\"1\" aria-pressed=\"true\">1×</button>\
         <button data-speed=\"4\" aria-pressed=\"false\">4×</button></span></div></section>",
        scrub.end_s
    );
}

/// Number and name of a frame, such as `3 Heart`.
fn name_of(frame: &FrameFigures) -> String {
    format!("{} {}", frame.frame + 1, escaped(&frame.name)).trim_end().to_owned()
}

fn happened(page: &mut String, report: &ShowReport) {
    page.push_str("<section class=\"box\"><div class=\"head\"><h2>What happened</h2></div><ol class=\"events\" tabindex=\"0\">");
    for incident in &report.incidents {
        let sign = match incident.tone {
            "bad" => "!",
            "look" => "▲",
            "good" => "✓",
            _ => "·",
        };
        let _ = write!(
            page,
            "<li><time>{}</time><span class=\"sign {}\" aria-hidden=\"true\">{sign}</span><p>{}</p></li>",
            clock_label(incident.at_s),
            incident.tone,
            escaped(&incident.line)
        );
    }
    page.push_str("</ol>");
    if report.incidents_left_out > 0 {
        let _ = write!(
            page,
            "<p class=\"faint\">{} not listed.</p>",
            count(report.incidents_left_out, "more event")
        );
    }
    page.push_str("</section>");
}

fn errors(page: &mut String, report: &ShowReport) {
    let names: Vec<String> = report.per_frame.iter().map(name_of).collect();
    let _ = write!(
        page,
        "<section class=\"box\"><div class=\"head\"><h2>Off the pixels at arrival</h2></div>{}</section>\
         <section class=\"box\"><div class=\"head\"><h2>Arrivals after the first robot</h2></div>{}</section>",
        charts::histogram(&report.errors_m, &report.position_error_m),
        charts::arrivals(&report.per_frame, &names)
    );
}

fn approaches(page: &mut String, report: &ShowReport) {
    if report.approaches.is_empty() {
        return;
    }
    page.push_str("<section class=\"box\"><div class=\"head\"><h2>Closest</h2></div><ul class=\"hb pairs\">");
    let widest_m = report.approaches.iter().map(|one| one.gap_m).fold(0.001, f64::max);
    for one in &report.approaches {
        let _ = write!(
            page,
            "<li><span>{}</span><span class=\"bars\"><i class=\"d\" style=\"width:{:.0}%\"></i></span>\
             <span class=\"num\">{}</span><span class=\"quiet\">frame {}</span><button class=\"jump\" data-at=\"{}\" \
             aria-label=\"Show that moment\"><svg viewBox=\"0 0 18 18\" aria-hidden=\"true\"><path d=\"M5 3l10 6-10 6z\"/></svg></button></li>",
            escaped(&one.robots.join(" and ")),
            100.0 * one.gap_m / widest_m,
            millimetres(one.gap_m),
            one.frame + 1,
            one.at_s
        );
    }
    page.push_str("</ul></section>");
}

fn robots(page: &mut String, robots: &[RobotFigures]) {
    let many = if robots.len() > ROWS_LAID_OUT { " many" } else { "" };
    let _ = write!(
        page,
        "<section class=\"box wide\"><div class=\"head\"><h2>Robots</h2></div>\
         <div class=\"scroll{many}\" tabindex=\"0\"><table><thead><tr>"
    );
    for title in
        ["Robot", "Arrivals", "Latest", "Off pixel", "Off route", "Brakes", "Nearest", "Messages", "Battery"]
    {
        let _ = write!(page, "<th scope=\"col\"><button class=\"sort\">{title}</button></th>");
    }
    page.push_str("</tr></thead><tbody>");
    for robot in robots {
        let class = if robot.is_lost { " class=\"lost\"" } else { "" };
        let lost = if robot.is_lost { " (lost)" } else { "" };
        let battery = match (robot.battery_began, robot.battery_ended) {
            (Some(began), Some(ended)) => format!("{began} → {ended} %"),
            _ => "–".into(),
        };
        let near = robot.near_m.map_or((-1.0, "–".into()), |near_m| (near_m, millimetres(near_m)));
        let _ = write!(
            page,
            "<tr{class}><th scope=\"row\">{}{lost}</th><td>{}</td><td data-key=\"{}\">{:.2} s</td><td data-key=\"{}\">{}</td>\
             <td data-key=\"{}\">{}</td><td>{}</td><td data-key=\"{}\">{}</td><td>{}</td><td data-key=\"{}\">{battery}</td></tr>",
            escaped(&robot.name),
            robot.arrivals,
            robot.latest_s,
            robot.latest_s,
            robot.position_error_m.max,
            millimetres(robot.position_error_m.max),
            robot.off_m,
            millimetres(robot.off_m),
            robot.brakes,
            near.0,
            near.1,
            robot.messages,
            robot.battery_ended.map_or(-1, i32::from),
        );
    }
    page.push_str("</tbody></table></div></section>");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ReportedEvent;

    #[test]
    fn names_are_text_and_nothing_else() {
        let evil = "<script>alert(1)</script>\"'&";
        let report = ShowReport {
            show: evil.into(),
            verdict: evil.into(),
            notes: vec![(evil.into(), evil.into())],
            incidents: vec![ReportedEvent { at_s: 1.0, tone: "look", line: evil.into(), robot: None }],
            per_frame: vec![FrameFigures { name: evil.into(), ..FrameFigures::default() }],
            per_robot: vec![RobotFigures { name: evil.into(), ..RobotFigures::default() }],
            ..ShowReport::default()
        };
        let page = page(&report, &Scrub::default());
        assert!(!page.contains("<script>alert"), "{page}");
        assert_eq!(page.matches("<script").count(), 4);
        assert_eq!(page, super::page(&report, &Scrub::default()), "the same bytes");
        assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("NaN"));
    }
}
