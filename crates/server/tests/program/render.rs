//! Renders films and sheets from the command line to files.

use std::io::BufReader;
use std::process::Command;

use serde_json::Value;

use crate::child::{Child, run};
use crate::{shows, wait_for};

fn made(robots: &str) -> String {
    let show = shows::file("film.lightbots.json", "");
    let (code, _, err) =
        run(&["make", "shape:heart", "text:HI", "--robots", robots, "--air", "1", "--out", &show]);
    assert_eq!((code, err.as_str()), (0, ""));
    show
}

/// Calls `render` twice and asserts that the files are equal. Returns its JSON and the bytes of the file.
fn rendered(show: &str, name: &str, more: &[&str]) -> (Value, Vec<u8>) {
    let write = || {
        let out = shows::file(name, "");
        let (code, text, err) = run(&[&["render", show, &out, "--json"], more].concat());
        assert_eq!((code, err.as_str()), (0, ""), "{text}");
        let summary: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(summary["ok"], true);
        (summary, std::fs::read(out).unwrap())
    };
    let (first, second) = (write(), write());
    assert!(first.1 == second.1, "{name}: the same bytes");
    first
}

#[test]
fn a_film_is_a_gif_of_the_whole_show_in_its_colours() {
    let show = made("12");
    let (summary, bytes) = rendered(&show, "film.gif", &["--size", "160x90", "--fps", "10"]);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(&bytes[..])).unwrap();
    assert_eq!((decoder.width(), decoder.height()), (160, 90));
    let (mut hundredths, mut brightest) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        hundredths += u32::from(frame.delay);
        brightest = brightest.max(frame.buffer.chunks(4).map(|pixel| pixel[0]).max().unwrap_or(0));
    }
    let duration_s = summary["duration_s"].as_f64().unwrap();
    // The film has a lead of 1.5 s, two frames of 1 s, and the drive between them.
    assert!(duration_s > 5.0 && (f64::from(hundredths) / 100.0 - duration_s).abs() < 0.02, "{summary}");
    assert!(brightest > 230, "lights are seen: {brightest}");
}

#[test]
fn sheets_are_a_png_and_a_pdf() {
    let show = made("12");
    let (_, png) = rendered(&show, "sheet.png", &["--view", "front"]);
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let (_, pdf) = rendered(&show, "crew.pdf", &[]);
    assert!(pdf.starts_with(b"%PDF-") && pdf.len() > 5_000);
    let text = String::from_utf8_lossy(&pdf);
    assert!(!text.contains("CreationDate") && !text.contains("ModDate"), "it has no dates");
}

#[test]
fn what_cannot_be_made_is_said() {
    let show = made("4");
    let refused = |arguments: &[&str]| {
        let (code, _, err) = run(&[&["render", &show], arguments].concat());
        (code, err)
    };
    for (arguments, said) in [
        (&["x.avi"][..], "write a film (.gif, .mp4, .webm)"),
        (&["x.mp4", "--size", "161x90"], "even"),
        (&["x.gif", "--size", "9x9"], "from 16 to 4096"),
        (&["x.gif", "--fps", "0"], "from 1 to 120"),
        (&["/nowhere/x.gif"], "cannot be written"),
    ] {
        let (code, err) = refused(arguments);
        assert!(code == 2 && err.contains(said), "{arguments:?}: {code} {err}");
    }
    let out = shows::file("film.mp4", "");
    let without =
        Command::new(env!("CARGO_BIN_EXE_lightbots")).args(["render", &show, &out]).env("PATH", "").output();
    let without = without.unwrap();
    let said = String::from_utf8_lossy(&without.stderr).into_owned();
    assert!(without.status.code() == Some(1) && said.contains("ffmpeg is not on the path"), "{said}");
}

/// Makes a video if `ffmpeg` is on the `PATH`.
#[test]
fn ffmpeg_makes_a_video() {
    if Command::new("ffmpeg").arg("-version").output().is_err() {
        return;
    }
    let show = made("6");
    let (_, mp4) = rendered(&show, "film.mp4", &["--size", "160x90", "--fps", "10"]);
    assert_eq!(&mp4[4..8], b"ftyp");
    let (_, webm) = rendered(&show, "film.webm", &["--size", "160x90", "--fps", "10"]);
    assert_eq!(webm[..4], [0x1a, 0x45, 0xdf, 0xa3]);
}

#[cfg(unix)]
#[test]
fn a_film_that_is_cancelled_leaves_nothing() {
    let show = made("40");
    let out = shows::file("long.gif", "");
    std::fs::remove_file(&out).unwrap();
    let folder = std::path::Path::new(&out).parent().unwrap().to_owned();
    let files = || std::fs::read_dir(&folder).unwrap().count();
    let before = files();
    let mut child = Child::lightbots(&["render", &show, &out, "--size", "1600x900", "--fps", "60"]);
    wait_for("a file that is not finished", || (files() > before).then_some(()));
    child.signal("-INT");
    assert!(child.end() == 130 && child.err().contains("cancelled; nothing was written"), "{}", child.err());
    assert_eq!(files(), before);
}
