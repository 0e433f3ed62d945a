//! The operator's screen, which plays the show and reads the log.

use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

use crate::common::Outcome;

/// Longest wait for the end of a show.
const PATIENCE: Duration = Duration::from_secs(600);

pub struct Screen {
    socket: WebSocket<TcpStream>,
    id: u32,
    ready: usize,
    is_planned: bool,
    /// Lines of the log that no call of `play` has read yet.
    log: Vec<String>,
    pub dropouts: usize,
    pub restarts: usize,
}

impl Screen {
    pub fn open(web: &str) -> Outcome<Self> {
        let stream = TcpStream::connect(web)?;
        let mut request = format!("ws://{web}/ws").into_client_request()?;
        request.headers_mut().insert("Origin", format!("http://{web}").parse()?);
        let (socket, _) = tungstenite::client(request, stream)?;
        Ok(Self { socket, id: 0, ready: 0, is_planned: false, log: Vec::new(), dropouts: 0, restarts: 0 })
    }

    pub fn wait_for_robots(&mut self, robots: usize) -> Outcome {
        while self.ready < robots || !self.is_planned {
            self.read()?;
        }
        Ok(())
    }

    /// Plays the show once. Returns its duration in seconds.
    pub fn play(&mut self) -> Outcome<f64> {
        let began = Instant::now();
        self.id += 1;
        let operation = json!({"do": "play", "from": 0, "missing": "refuse"});
        let request = json!({"type": "operate", "id": self.id, "operation": operation});
        self.socket.send(Message::text(request.to_string()))?;
        self.log.clear();
        while began.elapsed() < PATIENCE {
            self.read()?;
            for line in std::mem::take(&mut self.log) {
                if line.starts_with("Run finished") {
                    return Ok(began.elapsed().as_secs_f64());
                }
                if (line.starts_with("Run ") && line.contains("dropout")) || line.starts_with("answer: ") {
                    return Err(line.into());
                }
            }
        }
        Err("the show does not end".into())
    }

    fn read(&mut self) -> Outcome {
        let Message::Text(text) = self.socket.read()? else { return Ok(()) };
        let message: Value = serde_json::from_str(&text)?;
        match message["type"].as_str() {
            Some("state") => self.socket.send(Message::text(r#"{"type":"took"}"#))?,
            Some("fleet") => self.ready = message["rows"].as_array().map_or(0, Vec::len),
            Some("plan") => self.is_planned = message["planning"] == false,
            Some("answer") if message["ok"] != true => self.log.push(format!("answer: {message}")),
            Some("log") => self.note(message["text"].as_str().unwrap_or_default()),
            _ => {}
        }
        Ok(())
    }

    fn note(&mut self, line: &str) {
        self.restarts += usize::from(line.contains("started again"));
        if line.starts_with("Run finished") && !line.contains(" 0 dropouts") {
            self.dropouts += 1;
        }
        self.log.push(line.to_owned());
    }
}
