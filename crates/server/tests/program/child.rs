//! A child process: its output is kept, it is killed with the value.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child as Process, Command, Stdio};
use std::sync::{Arc, Mutex};

use crate::wait_for;

/// Lines that came so far.
type Lines = Arc<Mutex<Vec<String>>>;

pub struct Child {
    name: String,
    process: Process,
    out: Lines,
    err: Lines,
}

/// `lightbots` with a library of its own.
fn lightbots(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lightbots"));
    command.args(arguments).env("XDG_DATA_HOME", crate::shows::own_folder());
    command
}

impl Child {
    /// `lightbots` with these arguments.
    pub fn lightbots(arguments: &[&str]) -> Self {
        Self::lightbots_with(arguments, &[])
    }

    /// The same with variables in its environment.
    pub fn lightbots_with(arguments: &[&str], variables: &[(&str, &str)]) -> Self {
        let mut command = lightbots(arguments);
        command.envs(variables.iter().copied());
        Self::start(command, &arguments.join(" "))
    }

    /// `lightbots` with an input: Enter can be pressed.
    pub fn lightbots_at_terminal(arguments: &[&str]) -> Self {
        Self::spawn(lightbots(arguments), &arguments.join(" "), Stdio::piped())
    }

    /// Presses Enter; `lightbots_at_terminal` started the process.
    pub fn press_enter(&mut self) {
        let input = self.process.stdin.as_mut().expect("it has a terminal");
        input.write_all(b"\n").expect("it reads its input");
    }

    pub fn start(command: Command, name: &str) -> Self {
        Self::spawn(command, name, Stdio::null())
    }

    fn spawn(mut command: Command, name: &str, input: Stdio) -> Self {
        command.stdin(input).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut process = command.spawn().unwrap_or_else(|error| panic!("{name} does not start: {error}"));
        let out = keep(process.stdout.take().unwrap());
        let err = keep(process.stderr.take().unwrap());
        Self { name: name.to_owned(), process, out, err }
    }

    /// Waits until stderr holds this.
    pub fn complains(&mut self, part: &str) {
        let name = self.name.clone();
        wait_for(&format!("'{part}' from {name}"), || {
            if self.err().contains(part) {
                return Some(());
            }
            assert!(self.exit_code().is_none(), "{name} ended without '{part}'");
            None
        });
    }

    /// Everything it said on stdout.
    pub fn out(&self) -> String {
        self.out.lock().unwrap().join("\n")
    }

    /// Everything it said on stderr.
    pub fn err(&self) -> String {
        self.err.lock().unwrap().join("\n")
    }

    /// The text right after `before` on stdout, up to the next blank; waits for it.
    pub fn said(&mut self, before: &str) -> String {
        let name = self.name.clone();
        wait_for(&format!("'{before}' from {name}"), || {
            let out = self.out();
            if let Some((_, after)) = out.split_once(before) {
                return Some(after.split([' ', '\n', ',']).next().unwrap_or("").to_owned());
            }
            assert!(self.exit_code().is_none(), "{name} ended early");
            None
        })
    }

    /// How it ended, if it has.
    pub fn exit_code(&mut self) -> Option<i32> {
        self.process.try_wait().unwrap().map(|status| status.code().unwrap_or(-1))
    }

    /// Waits for its end; its exit code.
    pub fn end(&mut self) -> i32 {
        let name = self.name.clone();
        let code = wait_for(&format!("the end of {name}"), || self.exit_code());
        // Its last lines come through a thread of ours.
        wait_for("its last lines", || {
            (Arc::strong_count(&self.out) + Arc::strong_count(&self.err) == 2).then_some(())
        });
        code
    }

    /// Its number in the system.
    pub fn id(&self) -> u32 {
        self.process.id()
    }

    /// The processes that it has started.
    #[cfg(target_os = "linux")]
    pub fn children(&self) -> Vec<u32> {
        let list =
            Command::new("ps").args(["-o", "pid=", "--ppid", &self.id().to_string()]).output().unwrap();
        String::from_utf8_lossy(&list.stdout).split_whitespace().map(|id| id.parse().unwrap()).collect()
    }

    /// Sends TERM, as a service manager does.
    #[cfg(unix)]
    pub fn terminate(&self) {
        self.signal("-TERM");
    }

    /// Sends a signal by its option of `kill`.
    #[cfg(unix)]
    pub fn signal(&self, signal: &str) {
        let sent = Command::new("kill").args([signal, &self.process.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }

    /// Kills it and what it started, where it was started in a group of its own.
    #[cfg(unix)]
    pub fn kill_group(&mut self) {
        let group = format!("-{}", self.process.id());
        // It may have ended.
        let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
        self.kill();
    }

    pub fn kill(&mut self) {
        // It may have ended.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        self.kill();
        if std::thread::panicking() {
            eprintln!("--- {}: stdout\n{}\n--- stderr\n{}", self.name, self.out(), self.err());
        }
    }
}

/// Kills a process that is no child of ours.
#[cfg(target_os = "linux")]
pub fn kill(process: u32) {
    send_signal(process, "-KILL");
}

/// Sends a signal to a process that is no child of ours, by its option of `kill`.
#[cfg(target_os = "linux")]
pub fn send_signal(process: u32, signal: &str) {
    assert!(Command::new("kill").args([signal, &process.to_string()]).status().unwrap().success());
}

/// Keeps the lines of a pipe, from a thread.
fn keep(pipe: impl Read + Send + 'static) -> Lines {
    let lines = Lines::default();
    let kept = lines.clone();
    std::thread::spawn(move || {
        for line in BufReader::new(pipe).split(b'\n').map_while(Result::ok) {
            kept.lock().unwrap().push(String::from_utf8_lossy(&line).into_owned());
        }
    });
    lines
}

/// Runs `lightbots` with an input to its end: exit code, stdout, stderr.
pub fn run_with_input(arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut child = Child::lightbots_at_terminal(arguments);
    let mut pipe = child.process.stdin.take().expect("it has an input");
    pipe.write_all(input.as_bytes()).expect("it reads its input");
    drop(pipe);
    let code = child.end();
    (code, child.out(), child.err())
}

/// Runs `lightbots` to its end: exit code, stdout, stderr.
pub fn run(arguments: &[&str]) -> (i32, String, String) {
    let mut child = Child::lightbots(arguments);
    let code = child.end();
    (code, child.out(), child.err())
}
