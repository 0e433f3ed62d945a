//! The library keeps its shows over restarts of the program.

use crate::screen::Screen;
use crate::{alone, child, http, run, shows};

fn title(address: &str, name: &str) -> String {
    let got = http::request(address, "GET", &format!("/api/shows/{name}"), &[], "");
    assert_eq!(got.status, 200, "{name}: {}", got.body);
    got.json()["name"].as_str().unwrap().to_owned()
}

/// Saves a show titled `title` over `name`, as an editing screen does. Returns the name under which it is saved.
fn save(address: &str, name: &str, title: &str) -> String {
    let path = format!("/api/shows/{name}");
    let etag = http::request(address, "GET", &path, &[], "").header("ETag");
    let body = shows::row(2, &[1.0]).replace("Rows", title);
    let answer = http::request(address, "PUT", &path, &[("If-Match", &etag)], &body);
    assert_eq!(answer.status, 200, "{}", answer.body);
    answer.json()["name"].as_str().unwrap().to_owned()
}

#[test]
fn what_was_made_of_read_only_shows_is_there_after_a_restart() {
    let _turn = alone();
    let data = shows::folder().join("restarted");
    let file = shows::file("rows.lightbots.json", shows::row(2, &[1.0]));
    let arguments = ["--robots", "0", "--data", data.to_str().unwrap(), &file];
    {
        let (_server, address, _) = run::start(&arguments);
        assert_eq!(save(&address, "heart", "My heart"), "heart 2");
        assert_eq!(save(&address, "heart%202", "My heart again"), "heart 2");
        assert_eq!(save(&address, "rows", "My rows"), "rows 2");
        let refused = http::request(&address, "DELETE", "/api/shows/heart", &[], "");
        assert_eq!(refused.status, 403);
        assert!(refused.json()["error"].as_str().unwrap().contains("save a copy"), "{}", refused.body);
    }
    let (_server, address, _) = run::start(&arguments);
    assert_eq!(title(&address, "heart%202"), "My heart again");
    assert_eq!(title(&address, "rows%202"), "My rows");
    assert_eq!((title(&address, "rows"), title(&address, "heart")), ("Rows".into(), "Heart".into()));
}

#[test]
fn a_show_that_an_older_version_saved_under_the_name_of_an_example_is_found_and_opened() {
    let _turn = alone();
    let data = shows::folder().join("older");
    std::fs::create_dir_all(&data).unwrap();
    let file = data.join("heart.lightbots.json");
    let mine = shows::row(2, &[1.0]).replace("Rows", "My heart");
    std::fs::write(&file, &mine).unwrap();
    std::fs::write(data.join(".open"), "heart").unwrap();
    let (_server, address, _) = run::start(&["--robots", "0", "--data", data.to_str().unwrap()]);
    let mut screen = Screen::open(&address);
    screen.until("the show", |screen| (screen.get("show")["document"]["name"] == "My heart").then_some(()));
    assert_eq!(title(&address, "heart%20(example)"), "Heart");
    assert_eq!(save(&address, "heart%20(example)", "Another"), "heart 2");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), mine);
    assert_eq!(save(&address, "heart", "My heart again"), "heart");
}

#[test]
fn a_show_with_unknown_fields_opens_read_only_and_stays_as_it_is() {
    let _turn = alone();
    let data = shows::folder().join("future");
    std::fs::create_dir_all(&data).unwrap();
    let file = data.join("future.lightbots.json");
    let future = shows::row(2, &[1.0]).replacen("{\"lightbots\":1", "{\"lightbots\":3,\"glow\":1", 1);
    std::fs::write(&file, &future).unwrap();
    std::fs::write(data.join(".open"), "future").unwrap();
    let (_server, address, _) = run::start(&["--robots", "0", "--data", data.to_str().unwrap()]);
    let mut screen = Screen::open(&address);
    screen.until("the reason", |screen| {
        let reason = screen.get("show")["read_only"].as_str().map(str::to_owned);
        reason.filter(|reason| reason.contains("\"glow\" of the show"))
    });
    let path = "/api/shows/future";
    let shown = http::request(&address, "GET", path, &[], "");
    let refused = http::request(&address, "PUT", path, &[("If-Match", &shown.header("ETag"))], &shown.body);
    assert_eq!(refused.status, 403);
    assert!(refused.json()["error"].as_str().unwrap().contains("save a copy under another name"));
    assert_eq!(http::request(&address, "GET", "/api/shows/future/file", &[], "").body, future);
    let hash = "/api/assets/ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(http::request(&address, "PUT", hash, &[], "abd").status, 422);
    assert_eq!(http::request(&address, "PUT", hash, &[], "abc").status, 204);
    let asset = http::request(&address, "GET", hash, &[], "");
    assert_eq!((asset.body.as_str(), asset.header("X-Content-Type-Options").as_str()), ("abc", "nosniff"));
    let copy = http::request(&address, "PUT", "/api/shows/copy", &[("If-None-Match", "*")], &shown.body);
    assert_eq!((copy.status, &copy.json()["read_only"]), (200, &serde_json::Value::Null));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), future);
}

#[test]
fn a_second_program_on_the_same_data_says_which_process_has_it() {
    let data = shows::own_folder();
    let data = data.to_str().unwrap();
    let (mut server, address, _) = run::start(&["--robots", "0", "--data", data]);
    let second = ["run", "--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0", "--data", data];
    let (code, out, err) = child::run(&second);
    assert_eq!((code, out.as_str(), err.lines().count()), (1, "", 1), "{err}");
    let who = format!("process {} (http://{address})", server.id());
    assert!(err.contains(&who) && err.contains("--data DIR"), "{err}");
    assert_eq!(http::request(&address, "GET", "/api/shows", &[], "").status, 200);
    server.kill();
    let (_third, _, _) = run::start(&["--robots", "0", "--data", data]);
}

#[test]
fn earlier_saves_are_listed_looked_at_and_restored_over_http() {
    let (_server, address, _) = run::start(&["--robots", "0"]);
    let ask = |method: &str, path: &str| http::request(&address, method, path, &[], "");
    let body = shows::row(2, &[1.0]).replace("Rows", "v1");
    assert_eq!(http::request(&address, "PUT", "/api/shows/mine", &[], &body).status, 200);
    assert_eq!(save(&address, "mine", "v2"), "mine");
    let states = ask("GET", "/api/shows/mine/states").json();
    let (now, before) = (&states[0], &states[1]);
    assert_eq!((&now["title"], &now["number"]), (&"v2".into(), &serde_json::Value::Null));
    assert_eq!(
        (&before["title"], &before["frames"], &before["pixels"]),
        (&"v1".into(), &1.into(), &2.into())
    );
    assert!(before["saved_ms"].as_u64().unwrap() > 1_700_000_000_000);
    let old = ask("GET", &format!("/api/shows/mine/states/{}", before["number"]));
    assert_eq!(old.json()["name"], "v1");
    let etag = now["etag"].as_str().unwrap();
    let restored = http::request(&address, "PUT", "/api/shows/mine", &[("If-Match", etag)], &old.body);
    assert_eq!((restored.status, title(&address, "mine").as_str()), (200, "v1"));
    assert_eq!(ask("DELETE", "/api/shows/mine?renamed_to=..%2Fa").status, 400);
    for (path, status) in [("mine/states/99", 404), ("mine/states/x", 400), ("no/states", 404)] {
        assert_eq!(ask("GET", &format!("/api/shows/{path}")).status, status, "{path}");
    }
}
