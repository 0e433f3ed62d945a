//! Sign-in on a network address: roles, sessions, tokens and password guesses.

use serde_json::{Value, json};

use crate::child::{self, Child};
use crate::http::{self, Answer};
use crate::screen::Screen;
use crate::site::Site;
use crate::{alone, shows};

/// Columns of the table of SECURITY.md, which states for each column whether it may send a request.
const COLUMNS: [&str; 4] = ["before sign-in", "viewer", "editor", "operator"];

fn source(path: &str) -> String {
    std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn table() -> Vec<(String, [bool; 4])> {
    let text = source("../../SECURITY.md");
    let mut rows = text.lines().skip_while(|line| *line != format!("| request | {} |", COLUMNS.join(" | ")));
    rows.by_ref().take(2).for_each(drop);
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let [request, marks @ ..] = cells.as_slice() else { panic!("{line}") };
            let may: Vec<bool> = marks
                .iter()
                .map(|mark| match *mark {
                    "yes" => true,
                    "no" => false,
                    other => panic!("{other} in {line}"),
                })
                .collect();
            (request.trim_matches('`').to_owned(), may.try_into().unwrap())
        })
        .collect()
}

/// Starts a server on the network with these people. Returns the server, its data folder and its site.
pub fn start(people: &[(&str, &str)]) -> (Child, String, Site) {
    start_with(people, "0")
}

/// The same as [`start`], with this number of simulated robots.
pub fn start_with(people: &[(&str, &str)], robots: &str) -> (Child, String, Site) {
    let data = shows::own_folder().to_str().unwrap().to_owned();
    for (name, role) in people {
        let arguments = ["passwd", name, "--role", role, "--data", &data];
        let (code, out, err) = child::run_with_input(&arguments, &format!("password of {name}\n"));
        assert_eq!(code, 0, "{out}{err}");
    }
    let (child, site) = serve(&data, robots, &[]);
    (child, data, site)
}

/// Starts a server on the network with this data folder. The site trusts the server's own certificate.
pub fn start_on(data: &str, more: &[&str]) -> (Child, Site) {
    serve(data, "0", more)
}

fn serve(data: &str, robots: &str, more: &[&str]) -> (Child, Site) {
    let network =
        ["run", "--robots", robots, "--listen", "0.0.0.0:0", "--mqtt-listen", "127.0.0.1:0", "--data", data];
    let mut server = Child::lightbots(&[&network[..], more].concat());
    let address = server.said("LightBots is at https://");
    let site = Site::secure(&address, &format!("{data}/certs/server.pem"));
    (server, site)
}

pub fn sign_in(site: impl Into<Site>, name: &str, password: &str) -> Answer {
    let body = json!({"name": name, "password": password}).to_string();
    http::request(site, "POST", "/api/session", &[("Content-Type", "application/json")], &body)
}

/// Signs in. Returns the `Cookie` line of the new session.
pub fn session(site: impl Into<Site>, name: &str, password: &str) -> String {
    let site = site.into();
    let answer = sign_in(&site, name, password);
    assert_eq!(answer.status, 204, "{}", answer.body);
    cookie(&answer, site.scheme() == "https")
}

fn cookie(answer: &Answer, is_secure: bool) -> String {
    let line = answer.header("Set-Cookie");
    assert!(line.contains("; HttpOnly; SameSite=Strict;"), "{line}");
    assert_eq!(line.contains("; Secure;"), is_secure, "{line}");
    line.split(';').next().unwrap().to_owned()
}

fn get(site: &Site, path: &str, cookie: &str) -> Answer {
    http::request(site, "GET", path, &[("Cookie", cookie)], "")
}

/// Makes a token for a program with this role. Returns its `Authorization` value.
pub fn token(site: &Site, operator: &str, name: &str, role: &str) -> String {
    let body = json!({"name": name, "role": role}).to_string();
    let headers = [("Content-Type", "application/json"), ("Cookie", operator)];
    let answer = http::request(site, "POST", "/api/tokens", &headers, &body);
    assert_eq!(answer.status, 200, "{}", answer.body);
    format!("Bearer {}", answer.json()["token"].as_str().unwrap())
}

fn is_refused_for_sign_in(answer: &Answer) -> bool {
    let is_said = answer.body.contains("sign in first") || answer.body.contains("<title>Sign in");
    answer.status == 401 && is_said
}

fn is_refused_for_role(answer: &Answer) -> bool {
    answer.status == 403 && answer.body.contains("needs the role")
}

/// An operation with this name and all fields that any operation needs.
fn operation(name: &str) -> Value {
    let mut wish = json!({"frame": 0, "from": 0, "missing": "refuse", "on": false, "percent": 100, "incident": 1,
        "robot": "r1", "called": "", "robots": [], "listed": true, "pixel": 0, "name": "countdown", "address": "nonsense://", "user": null, "password": null});
    wish["do"] = name.into();
    wish
}

/// The names of all operations, from serde's error about an unknown one.
fn operations() -> Vec<String> {
    let error = serde_json::from_str::<lightbots_api::Operation>(r#"{"do":"?"}"#).unwrap_err().to_string();
    error.split('`').skip(3).step_by(2).map(str::to_owned).collect()
}

/// The routes in the server's source, such as `GET /api/shows`.
fn routes() -> Vec<String> {
    let text = source("src/web/mod.rs");
    let lines = text.lines().filter_map(|line| line.trim().strip_prefix(".route(\""));
    lines
        .flat_map(|line| {
            let (path, handlers) = line.split_once('"').unwrap();
            let ways =
                [("get(", "GET"), ("any(", "GET"), ("post(", "POST"), ("put(", "PUT"), ("delete(", "DELETE")];
            let called = |call: &str| {
                handlers.contains(&format!(", {call}")) || handlers.contains(&format!(".{call}"))
            };
            let methods = ways.iter().filter(|(call, _)| called(call)).map(|(_, method)| *method);
            methods.map(|method| format!("{method} {path}")).collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn each_cell_of_the_access_table_holds() {
    let _turn = alone();
    let table = table();
    let rows: Vec<&str> = table.iter().map(|(request, _)| request.as_str()).collect();
    let (operations, routes) = (operations(), routes());
    assert!(operations.len() > 15 && routes.len() > 15, "{operations:?} {routes:?}");
    for known in operations.iter().chain(&routes) {
        assert!(rows.contains(&known.as_str()), "{known} is missing in SECURITY.md");
    }
    assert_eq!(rows.len(), operations.len() + routes.len() + 1, "a row of SECURITY.md is of nothing");
    let (_server, _, site) = start(&[("ann", "operator")]);
    let operator = session(&site, "ann", "password of ann");
    let tokens: Vec<String> = COLUMNS[1..].iter().map(|role| token(&site, &operator, role, role)).collect();
    let lines = |column: usize| -> Vec<(&'static str, &str)> {
        if column == 0 { Vec::new() } else { vec![("Authorization", tokens[column - 1].as_str())] }
    };
    for (request, may) in table.iter().filter(|(request, _)| request.contains(' ')) {
        let (method, path) = request.split_once(' ').unwrap();
        for (column, may) in may.iter().enumerate() {
            // Each column uses another show. No token has that name.
            let name = format!("of-{}", COLUMNS[column].replace(' ', "-"));
            let path = path.replace("{name}", &name).replace("{number}", "1").replace("{*rest}", "none");
            let path = path.replace("{hash}", &"0".repeat(64));
            let headers = [lines(column), vec![("Content-Type", "application/json")]].concat();
            let answer = http::request(&site, method, &path, &headers, "{}");
            let is_refused =
                if column == 0 { is_refused_for_sign_in(&answer) } else { is_refused_for_role(&answer) };
            assert_eq!(is_refused, !may, "{request} {}: {} {}", COLUMNS[column], answer.status, answer.body);
        }
    }
    assert!(Screen::try_open(&site, &site.address).is_err());
    for column in 1..COLUMNS.len() {
        let mut screen = Screen::try_open_with(&site, &site.address, &lines(column)).unwrap();
        screen.wait_for_broker("connected");
        for (name, may) in table.iter().filter(|(request, _)| !request.contains(' ')) {
            let answer = screen.operate(operation(name));
            let is_refused = answer["error"].as_str().is_some_and(|error| error.contains("needs the role"));
            assert_eq!(is_refused, !may[column], "{name} {}: {answer}", COLUMNS[column]);
            assert!(!may[0] && (name != "stop_all" || answer["ok"] == true), "{name}: {answer}");
            let headers = [lines(column), vec![("Content-Type", "application/json")]].concat();
            let by_http =
                http::request(&site, "POST", "/api/operate", &headers, &operation(name).to_string());
            assert_eq!(is_refused_for_role(&by_http), !may[column], "{name}: {}", by_http.body);
        }
    }
}

#[test]
fn a_session_ends_at_sign_out_and_with_a_new_password() {
    let _turn = alone();
    let (_server, data, site) = start(&[("ann", "operator")]);
    let cookie = session(&site, "ann", "password of ann");
    let whoami = get(&site, "/api/session", &cookie).json();
    assert_eq!(whoami, json!({"name": "ann", "role": "operator"}));
    let open = |cookie: &str| Screen::try_open_with(&site, &site.address, &[("Cookie", cookie)]);
    let mut screen = open(&cookie).unwrap();
    screen.until("the greeting", |screen| (screen.get("hello")["plain_http"] == false).then_some(()));
    let out = http::request(&site, "DELETE", "/api/session", &[("Cookie", &cookie)], "");
    assert_eq!(out.status, 204);
    assert!(screen.is_hung_up(), "its WebSocket is closed");
    assert!(is_refused_for_sign_in(&get(&site, "/api/shows", &cookie)), "a stolen token is of no use");
    assert!(open(&cookie).is_err());

    let cookie = session(&site, "ann", "password of ann");
    let mut screen = open(&cookie).unwrap();
    let (code, out, _) = child::run_with_input(&["passwd", "ann", "--data", &data], "another password\n");
    assert_eq!((code, out.contains("ann (operator) has a new password")), (0, true), "{out}");
    assert!(screen.is_hung_up() && is_refused_for_sign_in(&get(&site, "/api/shows", &cookie)));
    assert_eq!(sign_in(&site, "ann", "password of ann").status, 401);
    session(&site, "ann", "another password");
}

#[test]
fn a_revoked_token_opens_nothing() {
    let _turn = alone();
    let (_server, data, site) = start(&[("ann", "operator")]);
    let operator = session(&site, "ann", "password of ann");
    let bearer = token(&site, &operator, "lights", "viewer");
    let kept = std::fs::read_to_string(format!("{data}/accounts.json")).unwrap();
    assert!(!kept.contains(bearer.trim_start_matches("Bearer ")), "only its hash is kept");
    let shows = || http::request(&site, "GET", "/api/shows", &[("Authorization", &bearer)], "");
    let mut screen = Screen::try_open_with(&site, &site.address, &[("Authorization", &bearer)]).unwrap();
    assert_eq!(shows().status, 200);
    let revoked = http::request(&site, "DELETE", "/api/tokens/lights", &[("Cookie", &operator)], "");
    assert_eq!(revoked.status, 204);
    assert!(is_refused_for_sign_in(&shows()) && screen.is_hung_up());
}

#[test]
fn a_removed_person_is_out_at_once_and_the_last_operator_stays() {
    let _turn = alone();
    let (_server, _, address) = start(&[("ann", "operator")]);
    let ann = session(&address, "ann", "password of ann");
    let ask = |method: &str, path: &str, cookie: &str, body: Value| {
        let headers = [("Content-Type", "application/json"), ("Cookie", cookie)];
        http::request(&address, method, path, &headers, &body.to_string())
    };
    let bob = json!({"name": "bob", "role": "operator", "password": "password of bob"});
    assert_eq!(
        ask("POST", "/api/people", &ann, json!({"name": "bob", "role": "viewer", "password": "x"})).status,
        422
    );
    assert_eq!(ask("POST", "/api/people", &ann, bob.clone()).status, 204);
    assert_eq!(ask("POST", "/api/people", &ann, bob).status, 409);
    let of_bob = session(&address, "bob", "password of bob");
    let bearer = token(&address, &of_bob, "lights", "operator");
    let by_token =
        |path: &str| http::request(&address, "GET", path, &[("Authorization", &bearer)], "").status;
    assert_eq!(by_token("/api/people"), 200);

    // A token never allows more than the account that made it.
    assert_eq!(ask("PUT", "/api/people/bob", &ann, json!({"role": "viewer"})).status, 204);
    assert_eq!((by_token("/api/people"), by_token("/api/shows")), (403, 200));
    assert_eq!(get(&address, "/api/session", &of_bob).json()["role"], "viewer");
    for (method, body) in [("DELETE", json!({})), ("PUT", json!({"role": "editor"}))] {
        let answer = ask(method, "/api/people/ann", &ann, body);
        assert!(answer.status == 409 && answer.body.contains("last operator"), "{}", answer.body);
    }

    let mut screen = Screen::try_open_with(&address, &address.address, &[("Cookie", &of_bob)]).unwrap();
    assert_eq!(ask("DELETE", "/api/people/bob", &ann, json!({})).status, 204);
    assert_eq!(ask("DELETE", "/api/people/bob", &ann, json!({})).status, 404);
    assert!(is_refused_for_sign_in(&get(&address, "/api/shows", &of_bob)) && screen.is_hung_up());
    assert_eq!((by_token("/api/shows"), sign_in(&address, "bob", "password of bob").status), (401, 401));
    assert_eq!(get(&address, "/api/tokens", &ann).json(), json!([]));

    assert_eq!(ask("PUT", "/api/people/ann", &ann, json!({"password": "a longer password"})).status, 204);
    assert!(is_refused_for_sign_in(&get(&address, "/api/shows", &ann)));
    session(&address, "ann", "a longer password");
}

#[test]
fn wrong_passwords_say_what_is_left_and_lead_to_a_pause() {
    let _turn = alone();
    let (_server, _, site) = start(&[("ann", "operator")]);
    for name in ["ann", "unknown"] {
        let lines: Vec<String> = (0..5)
            .map(|_| {
                let answer = sign_in(&site, name, "a guess");
                assert_eq!(answer.status, 401);
                answer.json()["error"].as_str().unwrap().to_owned()
            })
            .collect();
        assert_eq!(lines[2], "Name or password is wrong. Two more tries, then a pause of one minute.");
        assert_eq!(lines[4], "Name or password is wrong. Try again in one minute.");
        let answer = sign_in(&site, name, "password of ann");
        assert_eq!(answer.status, 429, "the right one, too, has to wait");
        assert!((1..=60).contains(&answer.header("Retry-After").parse::<u32>().unwrap()));
    }
}

#[test]
fn the_first_operator_comes_by_an_address_that_works_once() {
    let _turn = alone();
    let (mut server, _, site) = start(&[]);
    let first = server.said("#first=");
    // The QR code is printed after the address.
    server.said("█");
    let make = |token: &str, name: &str, password: &str| {
        let body = json!({"token": token, "name": name, "password": password}).to_string();
        http::request(&site, "POST", "/api/first", &[("Content-Type", "application/json")], &body)
    };
    assert_eq!(make("0", "eve", "a long password").status, 403);
    assert_eq!(make(&first, "eve", "short").status, 422);
    assert_eq!(make(&first, "a b", "a long password").status, 422);
    let made = make(&first, "ann", "a long password");
    assert_eq!(made.status, 204, "{}", made.body);
    assert_eq!(
        get(&site, "/api/people", &cookie(&made, true)).json(),
        json!([{"name": "ann", "role": "operator"}])
    );
    assert_eq!(make(&first, "eve", "a long password").status, 403);
    session(&site, "ann", "a long password");
}
