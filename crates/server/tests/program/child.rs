//! A child process whose output is kept. Dropping the value kills the process.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child as Process, Command, Stdio};
use std::sync::{Arc, Mutex};

use crate::wait_for;

/// Lines that a process has printed until now.
type Lines = Arc<Mutex<Vec<String>>>;

pub struct Child {
    name: String,
    process: Process,
    out: Lines,
    err: Lines,
}

/// A command for `lightbots`, whose usual data folder is new and empty.
fn lightbots(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lightbots"));
    command.args(arguments).env("XDG_DATA_HOME", crate::shows::own_folder());
    command
}

impl Child {
    /// Starts `lightbots` with these arguments.
    pub fn lightbots(arguments: &[&str]) -> Self {
        Self::lightbots_with(arguments, &[])
    }

    /// Starts `lightbots` with these arguments and environment variables.
    pub fn lightbots_with(arguments: &[&str], variables: &[(&str, &str)]) -> Self {
        let mut command = lightbots(arguments);
        command.envs(variables.iter().copied());
        Self::start(command, &arguments.join(" "))
    }

    /// Starts `lightbots` with a pipe as its input, so that Enter can be sent.
    pub fn lightbots_at_terminal(arguments: &[&str]) -> Self {
        Self::spawn(lightbots(arguments), &arguments.join(" "), Stdio::piped())
    }

    /// Sends Enter to a process that `lightbots_at_terminal` started.
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

    /// Waits until stderr contains this text.
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

    /// Everything that the process has printed on stdout.
    pub fn out(&self) -> String {
        self.out.lock().unwrap().join("\n")
    }

    /// Everything that the process has printed on stderr.
    pub fn err(&self) -> String {
        self.err.lock().unwrap().join("\n")
    }

    /// Waits for `before` on stdout. Returns the text right after it, up to the next blank, comma or end of line.
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

    /// The exit code if the process has ended. It is -1 after a signal.
    pub fn exit_code(&mut self) -> Option<i32> {
        self.process.try_wait().unwrap().map(|status| status.code().unwrap_or(-1))
    }

    /// Waits until the process has ended. Returns its exit code.
    pub fn end(&mut self) -> i32 {
        let name = self.name.clone();
        let code = wait_for(&format!("the end of {name}"), || self.exit_code());
        // The threads that read its output may still hold its last lines.
        wait_for("its last lines", || {
            (Arc::strong_count(&self.out) + Arc::strong_count(&self.err) == 2).then_some(())
        });
        code
    }

    /// Process id.
    pub fn id(&self) -> u32 {
        self.process.id()
    }

    /// Ids of its child processes.
    #[cfg(target_os = "linux")]
    pub fn children(&self) -> Vec<u32> {
        let list =
            Command::new("ps").args(["-o", "pid=", "--ppid", &self.id().to_string()]).output().unwrap();
        String::from_utf8_lossy(&list.stdout).split_whitespace().map(|id| id.parse().unwrap()).collect()
    }

    /// Sends SIGTERM, as a service manager does.
    #[cfg(unix)]
    pub fn terminate(&self) {
        self.signal("-TERM");
    }

    /// Sends a signal, named by an option of `kill` such as `-TERM`.
    #[cfg(unix)]
    pub fn signal(&self, signal: &str) {
        let sent = Command::new("kill").args([signal, &self.process.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }

    /// Kills the process and its children, if it was started in its own process group.
    #[cfg(unix)]
    pub fn kill_group(&mut self) {
        let group = format!("-{}", self.process.id());
        // The process may have ended already.
        let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
        self.kill();
    }

    pub fn kill(&mut self) {
        // The process may have ended already.
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

/// Kills a process that is not our child.
#[cfg(target_os = "linux")]
pub fn kill(process: u32) {
    send_signal(process, "-KILL");
}

/// Sends a signal to a process that is not our child. `signal` is an option of `kill`, such as `-TERM`.
#[cfg(target_os = "linux")]
pub fn send_signal(process: u32, signal: &str) {
    assert!(Command::new("kill").args([signal, &process.to_string()]).status().unwrap().success());
}

/// Reads the lines of a pipe in a thread, and returns them as they grow.
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

/// Runs `lightbots` with this input until it ends. Returns exit code, stdout and stderr.
pub fn run_with_input(arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut child = Child::lightbots_at_terminal(arguments);
    let mut pipe = child.process.stdin.take().expect("it has an input");
    pipe.write_all(input.as_bytes()).expect("it reads its input");
    drop(pipe);
    let code = child.end();
    (code, child.out(), child.err())
}

/// Runs `lightbots` until it ends. Returns exit code, stdout and stderr.
pub fn run(arguments: &[&str]) -> (i32, String, String) {
    let mut child = Child::lightbots(arguments);
    let code = child.end();
    (code, child.out(), child.err())
}
