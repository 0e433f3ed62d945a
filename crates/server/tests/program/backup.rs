//! Backup and restore of a data folder, even while a server uses it.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use serde_json::{Value, json};
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use crate::child::run;
use crate::run::start as start_on_loopback;
use crate::screen::Screen;
use crate::sign_in::{session, sign_in, start, start_on};
use crate::{alone, http, shows, wait_for};

/// Name of the file in a backup that lists its contents.
const LIST: &str = "lightbots-backup.json";

/// Bytes of all files in a folder and its subfolders, by their paths in it. The lock files of a program are left out.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap().map(Result::unwrap) {
            let path = entry.path();
            let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
            if path.is_dir() {
                open.push(path);
            } else if ![".lock", ".accounts-lock"].contains(&&*name) {
                found.insert(name, fs::read(path).unwrap());
            }
        }
    }
    found
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

/// Runs a command that must succeed. Returns its output.
fn must(arguments: &[&str]) -> String {
    let (code, out, err) = run(arguments);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    out
}

/// Runs a command that must fail with one line. Returns that line.
fn refused(arguments: &[&str]) -> String {
    let (code, out, err) = run(arguments);
    assert!((1..=2).contains(&code) && out.is_empty() && err.lines().count() == 1, "{code} {out} {err}");
    assert!(err.starts_with("error: "), "{err}");
    err
}

#[test]
fn a_folder_in_use_is_saved_and_another_server_goes_on_with_it() {
    let _turn = alone();
    let (server, data, address) = start(&[("ann", "operator")]);
    let cookie = session(&address, "ann", "password of ann");
    let save = |name: &str, title: &str| {
        let body = shows::row(3, &[0.5]).replace("Rows", title);
        let answer =
            http::request(&address, "PUT", &format!("/api/shows/{name}"), &[("Cookie", &cookie)], &body);
        assert_eq!(answer.status, 200, "{}", answer.body);
    };
    save("mine", "Mine");
    save("mine", "Mine again");
    let folder = shows::own_folder();
    let (file, other) = (path(&folder, "backup.zip"), path(&folder, "other/data"));
    let is_over = AtomicBool::new(false);
    let first = std::thread::scope(|scope| {
        // Each save replaces files and adds an earlier version.
        scope.spawn(|| {
            for number in 0.. {
                save(&format!("busy {number}").replace(' ', "%20"), "Busy");
                save("mine", &format!("Mine {number}"));
                if is_over.load(Ordering::Relaxed) {
                    return;
                }
            }
        });
        let said = must(&["backup", &file, "--data", &data]);
        is_over.store(true, Ordering::Relaxed);
        said
    });
    assert!(first.starts_with("Saved ") && first.contains(&file), "{first}");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
    }
    must(&["restore", &file, "--data", &other]);
    for (name, bytes) in files(Path::new(&other)) {
        assert!(!name.ends_with(".json") || serde_json::from_slice::<Value>(&bytes).is_ok(), "{name} is cut");
    }
    // Nothing changes any more, so the folder is restored byte for byte.
    must(&["backup", &file, "--data", &data, "--replace"]);
    let restored = must(&["restore", &file, "--data", &other, "--replace"]);
    let before = path(&folder, "other/data.before-1");
    assert!(restored.contains(&before), "{restored}");
    assert!(Path::new(&before).join("accounts.json").is_file());
    let (wanted, got) = (files(Path::new(&data)), files(Path::new(&other)));
    assert_eq!(got.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>());
    assert!(got == wanted && wanted.keys().any(|name| name.starts_with("history/mine/")));
    for name in ["mine.lightbots.json", "accounts.json", "certs/server.key"] {
        let about = |folder: &str| fs::metadata(Path::new(folder).join(name)).unwrap();
        let changed =
            |folder: &str| about(folder).modified().unwrap().duration_since(std::time::UNIX_EPOCH).unwrap();
        assert_eq!(changed(&data).as_millis(), changed(&other).as_millis(), "{name}");
        assert_eq!(about(&data).permissions(), about(&other).permissions(), "{name}");
    }
    drop(server);
    let (_server, address) = start_on(&other, &[]);
    let cookie = session(&address, "ann", "password of ann");
    let states = http::request(&address, "GET", "/api/shows/mine/states", &[("Cookie", &cookie)], "").json();
    assert!(states[0]["title"].as_str().unwrap().starts_with("Mine ") && states[1].is_object(), "{states}");
    assert_eq!(sign_in(&address, "ann", "another password").status, 401);
    let busy = refused(&["restore", &file, "--data", &other, "--replace"]);
    assert!(busy.contains("is in use by process"), "{busy}");
}

#[test]
fn a_backup_during_a_run_has_its_recording_and_starts_no_robot() {
    let _turn = alone();
    let data = shows::own_folder();
    let data = data.to_str().unwrap();
    let show = shows::row_file(4, &[0.2, 30.0]);
    let (server, address, _) = start_on_loopback(&["--robots", "4", "--data", data, &show]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.wait_for_log("To frame 2");
    let log = Path::new(data).join("runs/000001.lblog");
    wait_for("the log of the run", || fs::metadata(&log).is_ok_and(|log| log.len() > 1000).then_some(()));
    let folder = shows::own_folder();
    let (file, other) = (path(&folder, "backup.zip"), path(&folder, "data"));
    must(&["backup", &file, "--data", data]);
    must(&["restore", &file, "--data", &other]);
    let (code, out, err) = run(&["replay", "--json", "1", "--data", &other]);
    let replayed: Value = serde_json::from_str(&out).unwrap_or_default();
    assert_eq!(
        (code, &replayed["difference"], &replayed["complete"]),
        (0, &Value::Null, &json!(false)),
        "{out}{err}"
    );
    drop(server);
    // The journal of the run is in the data folder, but not in the backup.
    assert!(Path::new(data).join("runs/present.lbjournal").is_file());
    let (_server, address, _) =
        start_on_loopback(&["--robots", "4", "--data", &other, "--on-return", "go", &show]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    assert!(screen.log.iter().all(|line| !line.contains("To frame")), "{:?}", screen.log);
}

/// Writes a zip archive with these files, and the list as its last file. Returns its path.
fn archive(name: &str, list: &Value, entries: &[(&str, &str)]) -> String {
    let mut archive = ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let list = list.to_string();
    for (path, content) in entries.iter().chain(&[(LIST, list.as_str())]) {
        archive.start_file(*path, SimpleFileOptions::default()).unwrap();
        archive.write_all(content.as_bytes()).unwrap();
    }
    shows::file(name, archive.finish().unwrap().into_inner())
}

fn list(version: u32, files: &[(&str, usize)]) -> Value {
    let about = |bytes: usize| json!({"bytes": bytes, "modified_ms": 1, "is_private": false});
    let files: serde_json::Map<_, _> =
        files.iter().map(|(path, bytes)| ((*path).to_owned(), about(*bytes))).collect();
    json!({"lightbots_backup": version, "program": "9.9.9", "began_ms": 0, "files": files})
}

#[test]
fn what_is_no_sound_backup_is_refused_and_nothing_is_written() {
    let folder = shows::own_folder();
    let target = path(&folder, "inner/data");
    let good = archive("good.zip", &list(1, &[("a/b.json", 2)]), &[("a/b.json", "{}")]);
    let mut cut = fs::read(&good).unwrap();
    cut.truncate(cut.len() - 30);
    let mut flipped = fs::read(&good).unwrap();
    let at = flipped.windows(2).position(|bytes| bytes == b"b.").unwrap();
    flipped[at + 7] ^= 0x55;
    let two = [("a.json", "{}"), ("b.json", "{}")];
    let cases: Vec<(String, &str)> = vec![
        (path(&folder, "none.zip"), "none.zip cannot be restored"),
        ("/".into(), "not a regular file"),
        (shows::row_file(3, &[0.5]), "no backup of LightBots"),
        (shows::file("cut.zip", cut), "no backup of LightBots"),
        (shows::file("flipped.zip", flipped), "is damaged"),
        (archive("newer.zip", &list(2, &[]), &[]), "use LightBots 9.9.9 or a later one"),
        (archive("list.zip", &json!([]), &[]), "no backup of LightBots"),
        (archive("unlisted.zip", &list(1, &[("a.json", 2)]), &two), "differ in \"b.json\""),
        (
            archive("missing.zip", &list(1, &[("a.json", 2), ("c.json", 2)]), &two[..1]),
            "differ in \"c.json\"",
        ),
        (archive("longer.zip", &list(1, &[("a.json", 1)]), &two[..1]), "a.json in "),
        (archive("shorter.zip", &list(1, &[("a.json", 3)]), &two[..1]), "stated 3 bytes"),
        (archive("up.zip", &list(1, &[("../a.json", 2)]), &[("../a.json", "{}")]), "leads out of the folder"),
        (
            archive("inner.zip", &list(1, &[("a/../../b", 2)]), &[("a/../../b", "{}")]),
            "leads out of the folder",
        ),
        (
            archive("root.zip", &list(1, &[("/tmp/a.json", 2)]), &[("/tmp/a.json", "{}")]),
            "leads out of the folder",
        ),
        (archive("drive.zip", &list(1, &[("C:\\a", 2)]), &[("C:\\a", "{}")]), "do not trust it"),
        (
            archive(
                "run.zip",
                &list(1, &[("runs/present.lbjournal", 2)]),
                &[("runs/present.lbjournal", "{}")],
            ),
            "never holds",
        ),
    ];
    for (file, expected) in cases {
        let line = refused(&["restore", &file, "--data", &target]);
        assert!(line.contains(expected), "{file}: {line}");
        assert!(!Path::new(&target).exists(), "{file}");
        let left: Vec<_> = fs::read_dir(folder.join("inner")).into_iter().flatten().collect();
        assert!(left.is_empty(), "{file}: {left:?}");
    }
    must(&["restore", &good, "--data", &target]);
    assert_eq!(files(Path::new(&target)), BTreeMap::from([("a/b.json".to_owned(), b"{}".to_vec())]));
}

#[test]
fn a_folder_that_holds_something_is_never_overwritten() {
    let folder = shows::own_folder();
    let good = archive("good.zip", &list(1, &[("a.json", 2)]), &[("a.json", "{}")]);
    let target = folder.join("data");
    fs::create_dir_all(target.join("own")).unwrap();
    fs::write(target.join("own/picture"), b"mine").unwrap();
    let data = target.to_str().unwrap();
    let line = refused(&["restore", &good, "--data", data]);
    assert!(line.contains("holds files already") && line.contains("--replace"), "{line}");
    assert_eq!(files(&target), BTreeMap::from([("own/picture".to_owned(), b"mine".to_vec())]));
    must(&["restore", &good, "--data", data, "--replace"]);
    must(&["restore", &good, "--data", data, "--replace"]);
    assert_eq!(fs::read(folder.join("data.before-1/own/picture")).unwrap(), b"mine");
    assert!(folder.join("data.before-2/a.json").is_file() && target.join("a.json").is_file());
    // A folder counts as empty if it holds only a program's lock files.
    let empty = folder.join("empty");
    fs::create_dir_all(&empty).unwrap();
    fs::write(empty.join(".lock"), b"process 1").unwrap();
    must(&["restore", &good, "--data", empty.to_str().unwrap()]);
    assert!(empty.join("a.json").is_file());
}

#[test]
fn a_backup_goes_to_a_new_file_outside_of_the_folder() {
    let folder = shows::own_folder();
    let data = path(&folder, "data");
    let file = path(&folder, "backup.zip");
    assert!(refused(&["backup", &file, "--data", &data]).contains("there is no data folder"));
    fs::create_dir_all(Path::new(&data).join("runs")).unwrap();
    for (name, is_kept) in [
        ("a.lightbots.json", true),
        (".open", true),
        ("runs/000001.lblog", true),
        ("runs/present.lbjournal", false),
        (".a.lightbots.json.3.saving", false),
        (".lock", false),
    ] {
        fs::write(Path::new(&data).join(name), name).unwrap();
        assert_eq!(entries(&data, &file).contains(&name.to_owned()), is_kept, "{name}");
    }
    assert!(
        refused(&["backup", &path(Path::new(&data), "b.zip"), "--data", &data])
            .contains("in the data folder itself")
    );
    assert!(refused(&["backup", &path(&folder, "none/b.zip"), "--data", &data]).contains("make it first"));
    assert!(refused(&["backup", &file, "--data", &data]).contains("say --replace"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/etc/hostname", Path::new(&data).join("link")).unwrap();
        let (code, _, err) = run(&["backup", &file, "--data", &data, "--replace"]);
        assert!(code == 0 && err.contains("left out: ") && err.contains("link"), "{err}");
        let line = refused(&["backup", "/dev/full/b.zip", "--data", &data]);
        assert!(line.contains("/dev/full"), "{line}");
    }
}

/// Names of the files in a fresh backup of a data folder.
fn entries(data: &str, file: &str) -> Vec<String> {
    must(&["backup", file, "--data", data, "--replace"]);
    let mut archive = ZipArchive::new(fs::File::open(PathBuf::from(file)).unwrap()).unwrap();
    let mut text = String::new();
    archive.by_name(LIST).unwrap().read_to_string(&mut text).unwrap();
    let list: Value = serde_json::from_str(&text).unwrap();
    let names: Vec<String> = list["files"].as_object().unwrap().keys().cloned().collect();
    assert_eq!(archive.len(), names.len() + 1);
    names
}
