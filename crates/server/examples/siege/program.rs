//! The process that is attacked.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::common::{self, Outcome};

/// Time between two measurements of the memory of the attacked program.
const LOOK: Duration = Duration::from_millis(200);

pub struct Program {
    child: Child,
    folder: PathBuf,
    pub web: String,
    pub broker: String,
    peak_bytes: Arc<AtomicU64>,
}

impl Program {
    /// Starts `lightbots run` with thirty robots and an empty library.
    pub fn start() -> Outcome<Self> {
        let folder = std::env::temp_dir().join(format!("lightbots-siege-{}", std::process::id()));
        let show = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shows/hello.json");
        let mut child = Command::new(common::program()?)
            .args(["run", "--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0", "--log", "off"])
            .arg("--data")
            .arg(&folder)
            .arg(show)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let mut lines = BufReader::new(child.stdout.take().ok_or("no stdout")?).lines();
        let mut after = |mark: &str| -> Outcome<String> {
            let line = lines.next().ok_or("the program ended")??;
            let (_, rest) = line.split_once(mark).ok_or(format!("no address in '{line}'"))?;
            Ok(rest.split([' ', ',']).next().unwrap_or_default().to_owned())
        };
        let (web, broker) = (after("http://")?, after("mqtt://")?);
        let peak_bytes = Arc::new(AtomicU64::new(0));
        let (peak, id) = (peak_bytes.clone(), child.id());
        std::thread::spawn(move || {
            while let Some(bytes) = resident_bytes(id) {
                peak.fetch_max(bytes, Ordering::Relaxed);
                std::thread::sleep(LOOK);
            }
        });
        Ok(Self { child, folder, web, broker, peak_bytes })
    }

    /// Peak memory of program and broker together, bytes.
    pub fn peak_bytes(&self) -> u64 {
        self.peak_bytes.load(Ordering::Relaxed)
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// Resident memory of a process and its children, bytes. `None` if the process has ended.
fn resident_bytes(id: u32) -> Option<u64> {
    let own = resident_kb(id)?;
    let list = std::fs::read_to_string(format!("/proc/{id}/task/{id}/children")).unwrap_or_default();
    let children = list.split_whitespace().filter_map(|child| resident_kb(child.parse().ok()?));
    Some((own + children.sum::<u64>()) << 10)
}

fn resident_kb(id: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches(" kB").parse().ok()
}
