//! Absurd layers of light from a file and over HTTP: each is reported, and no data is lost.

use serde_json::Value;

use crate::run::start;
use crate::{alone, child, http, shows};

/// A show with these layers, as JSON.
fn with(layers: &str) -> String {
    shows::row(2, &[1.0]).replacen("\"lightbots\":1", &format!("\"lightbots\":2,\"layers\":[{layers}]"), 1)
}

fn layer(kind: &str, settings: &str) -> String {
    format!(r#"{{"kind":"{kind}","name":"Absurd","settings":{{{settings}}}}}"#)
}

/// Layers that cannot be read, each with its error.
fn unreadable() -> [(String, &'static str); 3] {
    [
        (vec![layer("solid", ""); 100_000].join(","), "more than 1000 layers; take some away"),
        (layer("wave", "\"size_m\":NaN"), "the setting \"size_m\" is NaN, not a number; give it a number"),
        (
            layer("solid", &format!("\"opacity\":[{}]", vec!["[0,1]"; 1_000_000].join(","))),
            "more than 20000 values in one group of settings; simplify the setting \"opacity\"",
        ),
    ]
}

/// Layers that give no light, each with its issue.
fn dark() -> [(String, &'static str); 2] {
    [
        (
            layer("strobe", "\"speed_hz\":1000"),
            "the layer \"Absurd\": speed_hz is 1000: choose a number from -3 to 3",
        ),
        (
            layer("solid", &format!("\"opacity\":[{}]", vec!["0"; 11_000].join(","))),
            "the layer \"Absurd\": opacity",
        ),
    ]
}

/// Messages of all issues with this code.
fn messages(issues: &Value, code: &str) -> Vec<String> {
    let issues = issues.as_array().unwrap().iter().filter(|issue| issue["code"] == code);
    issues.map(|issue| issue["message"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn check_names_file_place_and_remedy_of_absurd_layers() {
    for (layers, said) in unreadable() {
        let file = shows::file("absurd.lightbots.json", with(&layers));
        let (code, out, err) = child::run(&["check", &file]);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
        assert!(err.contains(&file) && err.contains("line 1, column ") && err.contains(said), "{err}");
    }
    for (layers, said) in dark() {
        let file = shows::file("absurd.lightbots.json", with(&layers));
        let (code, out, err) = child::run(&["check", &file, "--json"]);
        let report: Value = serde_json::from_str(&out).unwrap();
        let found = messages(&report["issues"], "bad-layer");
        assert!(code == 0 && found.len() == 1 && found[0].contains(said), "{code} {found:?} {err}");
    }
}

#[test]
fn an_upload_of_absurd_layers_is_refused_or_kept_whole_and_what_was_saved_stays() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0"]);
    let path = "/api/shows/mine";
    let ask = |method: &str, headers: &[(&str, &str)], body: &str| {
        http::request(&address, method, path, headers, body)
    };
    let sound = with(&layer("rainbow", "\"speed_hz\":0.2"));
    assert_eq!(ask("PUT", &[], &sound).status, 200);
    let saved = ask("GET", &[], "");
    let etag = saved.header("ETag");
    for (layers, said) in unreadable() {
        let refused = ask("PUT", &[("If-Match", &etag)], &with(&layers));
        let error = refused.json()["error"].as_str().unwrap().to_owned();
        assert!(refused.status == 422 && error.contains(said), "{} {error}", refused.status);
        let checked = http::request(&address, "POST", "/api/check", &[], &with(&layers)).json();
        let issue = &checked["issues"][0];
        assert!(checked["ok"] == false && issue["message"].as_str().unwrap().contains(said), "{issue}");
        let still = ask("GET", &[], "");
        assert_eq!((&still.body, still.header("ETag")), (&saved.body, etag.clone()));
    }
    let mut etag = etag;
    for (layers, said) in dark() {
        let kept = ask("PUT", &[("If-Match", &etag)], &with(&layers));
        assert_eq!(kept.status, 200, "{}", kept.body);
        let document = ask("GET", &[], "");
        etag = document.header("ETag");
        let sent: Value = serde_json::from_str(&with(&layers)).unwrap();
        assert_eq!(
            document.json()["layers"][0]["settings"],
            sent["layers"][0]["settings"],
            "nothing is lost"
        );
        let checked = http::request(&address, "POST", "/api/check", &[], &document.body).json();
        let found = messages(&checked["issues"], "bad-layer");
        assert!(found.len() == 1 && found[0].contains(said), "{found:?}");
    }
}
