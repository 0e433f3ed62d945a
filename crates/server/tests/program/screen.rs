//! A screen's side of the WebSocket, without a browser.

use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

use crate::DEADLINE;
use crate::site::{Line, Site};

/// The robots of a binary message as JSON. Unknown values are null.
fn robots(bytes: &[u8]) -> Value {
    let robots = lightbots_api::Robots::from_bytes(bytes).expect("a binary message that is not the robots");
    // Places are rounded to 0.1 mm, the unit of the message.
    let metres = |list: Vec<f32>| -> Vec<f64> {
        list.into_iter().map(|number| (f64::from(number) * 1e4).round() / 1e4).collect()
    };
    let (planned_x, planned_y) = (metres(robots.planned_x), metres(robots.planned_y));
    json!({
        "x": metres(robots.x), "y": metres(robots.y), "planned_x": planned_x, "planned_y": planned_y,
        "goal_x": metres(robots.goal_x), "goal_y": metres(robots.goal_y), "colour": robots.colour,
        "status": robots.status,
    })
}

pub struct Screen {
    socket: WebSocket<Line>,
    requests: u32,
    /// The last message of each type.
    pub last: std::collections::BTreeMap<String, Value>,
    /// The log, line by line.
    pub log: Vec<String>,
}

impl Screen {
    /// Connects to a site as a page of `origin` (`host:port`) does.
    pub fn try_open(site: impl Into<Site>, origin: &str) -> Result<Self, String> {
        Self::try_open_with(site, origin, &[])
    }

    /// Connects as [`Self::try_open`] does, with further header lines.
    pub fn try_open_with(
        site: impl Into<Site>,
        origin: &str,
        headers: &[(&'static str, &str)],
    ) -> Result<Self, String> {
        let site = site.into();
        let stream = site.connect().map_err(|error| error.to_string())?;
        stream.set_read_timeout(Duration::from_millis(100));
        let mut request = format!("ws://{}/ws", site.address).into_client_request().unwrap();
        let origin = format!("{}://{origin}", site.scheme());
        request.headers_mut().insert("Origin", origin.parse().unwrap());
        for (name, value) in headers {
            request.headers_mut().insert(*name, value.parse().unwrap());
        }
        let until = Instant::now() + DEADLINE;
        let mut attempt = tungstenite::client(request, stream);
        let (socket, _) = loop {
            match attempt {
                Ok(done) => break done,
                Err(tungstenite::HandshakeError::Interrupted(middle)) if Instant::now() < until => {
                    attempt = middle.handshake();
                }
                Err(error) => return Err(error.to_string()),
            }
        };
        Ok(Self { socket, requests: 0, last: Default::default(), log: Vec::new() })
    }

    pub fn open(address: &str) -> Self {
        Self::try_open(address, address).unwrap()
    }

    /// Reads messages until `look` returns a value for the state of this screen. Panics after [`DEADLINE`].
    pub fn until<T>(&mut self, what: &str, mut look: impl FnMut(&Self) -> Option<T>) -> T {
        let until = Instant::now() + DEADLINE;
        loop {
            if let Some(found) = look(self) {
                return found;
            }
            assert!(
                Instant::now() < until,
                "waited in vain for {what}; state {}\nlog {:#?}",
                self.get("state"),
                self.log
            );
            self.read();
        }
    }

    fn read(&mut self) {
        let message = match self.socket.read() {
            Ok(Message::Text(text)) => serde_json::from_str::<Value>(&text).unwrap(),
            Ok(Message::Binary(bytes)) => {
                self.last.insert("robots".into(), robots(&bytes));
                return;
            }
            Ok(_) => return,
            Err(tungstenite::Error::Io(error))
                if matches!(error.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut) =>
            {
                return;
            }
            Err(error) => panic!("the server hung up: {error}"),
        };
        let kind = message["type"].as_str().unwrap().to_owned();
        if kind == "log" {
            self.log.push(message["text"].as_str().unwrap().to_owned());
        }
        if kind == "state" {
            self.send_text(r#"{"type":"took"}"#);
        }
        self.last.insert(kind, message);
    }

    /// The last message of this type. Null before the first one.
    pub fn get(&self, kind: &str) -> Value {
        self.last.get(kind).cloned().unwrap_or_default()
    }

    /// Sends an operation and waits for its answer.
    pub fn operate(&mut self, operation: Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        let request = json!({"type": "operate", "id": id, "operation": operation});
        self.socket.send(Message::text(request.to_string())).unwrap();
        self.until("an answer", |screen| Some(screen.get("answer")).filter(|answer| answer["id"] == id))
    }

    /// Sends an operation and asserts that it succeeds.
    pub fn must(&mut self, operation: Value) {
        let answer = self.operate(operation.clone());
        assert_eq!(answer["ok"], true, "{operation}: {answer}");
    }

    pub fn send_text(&mut self, text: &str) {
        self.socket.send(Message::text(text)).unwrap();
    }

    /// Whether the server closes the connection before [`DEADLINE`].
    pub fn is_hung_up(&mut self) -> bool {
        let until = Instant::now() + DEADLINE;
        while Instant::now() < until {
            match self.socket.read() {
                Ok(Message::Close(_)) => return true,
                Err(tungstenite::Error::Io(error))
                    if matches!(
                        error.kind(),
                        std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut
                    ) => {}
                Err(_) => return true,
                Ok(_) => {}
            }
        }
        false
    }

    /// The phase of the playback, such as `playing`. Empty before the first state.
    pub fn phase(&self) -> String {
        self.get("state")["playback"]["phase"].as_str().unwrap_or("").to_owned()
    }

    /// Places of the robots. Empty until all of them are known.
    pub fn places(&self) -> Vec<(f64, f64)> {
        let robots = &self.get("robots");
        let list = |key: &str| {
            robots[key].as_array().map(|list| list.iter().map(Value::as_f64).collect::<Option<Vec<_>>>())
        };
        match (list("x").flatten(), list("y").flatten()) {
            (Some(x), Some(y)) => x.into_iter().zip(y).collect(),
            _ => Vec::new(),
        }
    }

    /// Waits until the link to the broker is in this phase, and returns its state. The server listens before that link
    /// exists.
    pub fn wait_for_broker(&mut self, phase: &str) -> Value {
        self.until(phase, |screen| {
            Some(screen.get("state")["broker"].clone()).filter(|broker| broker["phase"] == phase)
        })
    }

    /// Waits until exactly this number of robots is ready, and the plan of the open show is made.
    pub fn wait_for_robots(&mut self, count: usize) {
        self.until(&format!("{count} robots"), |screen| {
            let is_planned = screen.get("plan")["planning"] == false;
            (screen.places().len() == count && screen.phase() == "ready" && is_planned).then_some(())
        });
    }

    /// Waits for a line of the log that contains this text, and returns the line.
    pub fn wait_for_log(&mut self, part: &str) -> String {
        self.until(&format!("the line '{part}'"), |screen| {
            screen.log.iter().find(|line| line.contains(part)).cloned()
        })
    }
}
