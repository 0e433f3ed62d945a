//! A rehearsal's report as a page that needs nothing but itself.

use std::fmt::Write as _;

use crate::report::{FrameRecord, RehearsalReport};
use crate::statistics::Spread;

/// Width of a chart, CSS pixels.
const WIDTH: f64 = 720.0;
/// Height of a chart's bars, CSS pixels.
const HEIGHT: f64 = 120.0;
/// The most issues listed.
const ISSUES_MAX: usize = 200;
/// The most frames listed and drawn.
const FRAMES_MAX: usize = 1000;

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:760px;margin:2em auto;padding:0 1em;\
background:#101216;color:#e6e8ec}h1{font-size:1.5em}h2{font-size:1.1em;margin-top:2em}table{border-collapse:collapse}\
td,th{padding:.2em .9em .2em 0;text-align:left;font-variant-numeric:tabular-nums}th{color:#9aa3b2;font-weight:500}\
.ok{color:#5ee08a}.bad{color:#ff7a70}svg{display:block;width:100%;height:auto}li.error{color:#ff7a70}\
li.warning{color:#ffc861}";

impl RehearsalReport {
    /// A self-contained HTML page: figures, charts over the frames, issues. `title` is plain text.
    pub fn html(&self, title: &str) -> String {
        let mut page = String::from("<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>");
        let title = escaped(title);
        let (class, verdict) = if self.ok { ("ok", "fine") } else { ("bad", "not fine") };
        // Writing into a String cannot fail.
        let _ = write!(
            page,
            "{title}: rehearsal</title><meta name=\"viewport\" content=\"width=device-width\"><style>{STYLE}</style>\
             <h1>{title}: <span class=\"{class}\">{verdict}</span></h1>"
        );
        self.figures(&mut page);
        let frames = &self.per_frame[..self.per_frame.len().min(FRAMES_MAX)];
        chart(&mut page, "Arrivals: first to last, ms", frames, |frame| frame.arrival_spread_s * 1e3);
        chart(&mut page, "Farthest from its pixel, mm", frames, |frame| frame.position_error_m.max * 1e3);
        frame_table(&mut page, frames);
        self.issue_list(&mut page);
        page.push_str("</html>\n");
        page
    }

    fn figures(&self, page: &mut String) {
        let closest = self.closest_m.map_or("-".into(), |metres| format!("{:.1} mm", metres * 1e3));
        let speed = self.real_time_factor.map_or("-".into(), |factor| format!("{factor:.0} ×"));
        let rows = [
            ("Robots", self.robots.to_string()),
            ("Frames played", format!("{} of {}", self.frames_played, self.frames)),
            ("Duration", format!("{:.2} s (at least {:.2} s)", self.duration_s, self.lower_bound_s)),
            ("Contacts", self.contacts.to_string()),
            ("Touches of the floor's edge", self.edge_touches()),
            ("Brakes", format!("{}, {} of them false", self.brakes.all, self.brakes.unfounded)),
            ("Closest centres", closest),
            ("Arrivals within", three(&self.arrival_spread_s, "ms")),
            ("Position error", three(&self.position_error_m, "mm")),
            ("Estimate error on the way", three(&self.estimate_error_m, "mm")),
            ("Tracking error on the way", three(&self.tracking_error_m, "mm")),
            ("Clocks within", three(&self.clock_spread_s, "ms")),
            ("Messages", format!("{} sent, {} lost", self.messages.sent, self.messages.lost)),
            ("Robots lost", self.dropouts.to_string()),
            ("Seed", self.seed.to_string()),
            ("State hash", self.state_hash.clone()),
            ("Times real time", speed),
        ];
        page.push_str("<table>");
        for (name, value) in rows {
            let _ = write!(page, "<tr><th>{name}</th><td>{}</td></tr>", escaped(&value));
        }
        page.push_str("</table>");
    }

    fn issue_list(&self, page: &mut String) {
        if self.issues.is_empty() {
            return;
        }
        page.push_str("<h2>Issues</h2><ul>");
        for issue in self.issues.iter().take(ISSUES_MAX) {
            let class = format!("{:?}", issue.severity).to_lowercase();
            let _ = write!(page, "<li class=\"{class}\">{}</li>", escaped(&issue.message));
        }
        if self.issues.len() > ISSUES_MAX {
            let _ = write!(page, "<li>and {} more</li>", self.issues.len() - ISSUES_MAX);
        }
        page.push_str("</ul>");
    }
}

/// Median, 99th percentile and greatest of seconds or metres, in thousandths.
fn three(of: &Spread, unit: &str) -> String {
    let Spread { median, p99, max } = of;
    format!("{:.1} / {:.1} / {:.1} {unit} (median / p99 / max)", median * 1e3, p99 * 1e3, max * 1e3)
}

/// One bar a frame.
fn chart(page: &mut String, title: &str, frames: &[FrameRecord], value: impl Fn(&FrameRecord) -> f64) {
    let highest = frames.iter().map(&value).fold(0.0, f64::max);
    if highest <= 0.0 {
        return;
    }
    let step = WIDTH / frames.len() as f64;
    let _ = write!(
        page,
        "<h2>{title}</h2><svg viewBox=\"0 0 {WIDTH} {}\" role=\"img\"><title>{title}, by frame</title>",
        HEIGHT + 20.0
    );
    for (index, frame) in frames.iter().enumerate() {
        let height = HEIGHT * value(frame) / highest;
        let _ = write!(
            page,
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{height:.2}\" rx=\"1.5\" fill=\"#6aa8ff\">\
             <title>{} {}: {:.1}</title></rect>",
            index as f64 * step + 0.1 * step,
            20.0 + HEIGHT - height,
            0.8 * step,
            frame.frame + 1,
            escaped(&frame.name),
            value(frame)
        );
    }
    let _ =
        write!(page, "<text x=\"0\" y=\"14\" fill=\"#9aa3b2\" font-size=\"12\">{highest:.1}</text></svg>");
}

fn frame_table(page: &mut String, frames: &[FrameRecord]) {
    page.push_str(
        "<h2>Frames</h2><table><tr><th>Frame</th><th>Stands at</th><th>Drive</th><th>Arrivals within</th>\
         <th>Position error (median, max)</th><th>Pixels shown</th></tr>",
    );
    for frame in frames {
        let _ = write!(
            page,
            "<tr><td>{} {}</td><td>{:.2} s</td><td>{:.2} s</td><td>{:.0} ms</td><td>{:.1}, {:.1} mm</td><td>{}</td></tr>",
            frame.frame + 1,
            escaped(&frame.name),
            frame.at_s,
            frame.drive_s,
            frame.arrival_spread_s * 1e3,
            frame.position_error_m.median * 1e3,
            frame.position_error_m.max * 1e3,
            frame.pixels_shown
        );
    }
    page.push_str("</table>");
}

/// Text that is nothing but text in HTML, attributes included; control characters become spaces.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brakes::BrakeCounts;
    use crate::network::MessageCounts;
    use lightbots_show::Issue;

    fn report() -> RehearsalReport {
        let evil = "<script>alert('x')</script>&\"";
        let position_error_m = Spread { median: 0.001, p99: 0.004, max: 0.005 };
        let frame = FrameRecord {
            frame: 0,
            name: evil.into(),
            at_s: 3.25,
            drive_s: 3.0,
            arrival_spread_s: 0.12,
            position_error_m,
            pixels_shown: 30,
        };
        RehearsalReport {
            ok: false,
            robots: 30,
            frames_played: 1,
            frames: 2,
            duration_s: 4.0,
            planned_s: 0.0,
            replans: 0,
            contacts_after_replan: 0,
            lower_bound_s: 3.0,
            contacts: 0,
            wall_contacts: 3,
            wall_pressed_m: 0.0017,
            brakes: BrakeCounts { all: 5, unfounded: 2 },
            closest_m: Some(0.0612),
            arrival_spread_s: Spread { median: 0.12, p99: 0.12, max: 0.12 },
            position_error_m,
            estimate_error_m: Spread { median: 0.0008, p99: 0.002, max: 0.003 },
            tracking_error_m: Spread { median: 0.0011, p99: 0.003, max: 0.004 },
            clock_spread_s: Spread { median: 0.0015, p99: 0.002, max: 0.002 },
            stop_after_crash_s: None,
            messages: MessageCounts { sent: 100, lost: 3 },
            dropouts: 0,
            seed: 7,
            state_hash: "00ff".into(),
            real_time_factor: None,
            issues: vec![Issue::error("x", evil)],
            per_frame: vec![frame],
        }
    }

    #[test]
    fn nothing_of_a_show_becomes_markup() {
        let page = report().html("<b>&");
        assert!(!page.contains("<script") && !page.contains("<b>"));
        assert_eq!(page.matches("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&amp;&quot;").count(), 4);
    }

    #[test]
    fn the_page_says_the_figures_and_needs_no_other_file() {
        let page = report().html("3210");
        for text in [
            "not fine",
            "1 of 2",
            "61.2 mm",
            "5, 2 of them false",
            "3, at most 1.7 mm over it",
            "100 sent, 3 lost",
            "120.0 / 120.0 / 120.0 ms",
            "0.8 / 2.0 / 3.0 mm",
            "1.1 / 3.0 / 4.0 mm",
            "1.5 / 2.0 / 2.0 ms",
            "<svg",
            "3.25 s",
        ] {
            assert!(page.contains(text), "{text}");
        }
        assert!(!page.contains("http") && !page.contains("src="));
    }
}
