//! What people set for single robots, kept in a file: display names, and which robots may take part in runs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbots_base::RobotId;
use serde::{Deserialize, Serialize};

use crate::disk::{self, Readers};
use crate::json_file;

/// Name of the file in the data folder.
const FILE: &str = "robots.json";
/// Longest display name of a robot, characters.
const CALLED_MAX: usize = 40;
/// Most robots whose settings are kept: twice the largest fleet.
const ROBOTS_MAX: usize = 20_000;
/// Longest file that is read, bytes. A longer one cannot be used; see [`json_file::load`].
const FILE_MAX: u64 = 8 << 20;

/// Display names of robots, and the list of robots that may take part in runs. Clones share the content.
#[derive(Clone, Debug)]
pub struct FleetBook {
    path: PathBuf,
    kept: Arc<Mutex<Kept>>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Kept {
    /// Whether only listed robots take part in runs.
    #[serde(default)]
    only_listed: bool,
    /// Settings of robots, by their names in messages.
    #[serde(default)]
    robots: BTreeMap<String, About>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct About {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    called: Option<String>,
    #[serde(default)]
    listed: bool,
}

impl FleetBook {
    /// Reads the file in the data folder. The result is empty if the file is missing or cannot be used; see
    /// [`json_file::load`].
    pub fn load(folder: &Path) -> Self {
        let path = folder.join(FILE);
        let kept: Kept = json_file::load(&path, FILE_MAX);
        Self { path, kept: Arc::new(Mutex::new(kept)) }
    }

    /// Gives a robot a display name, in which runs of white space become one space. An empty name removes it. The error
    /// is a line for people: for example, the name is too long or another robot has it.
    pub fn call(&self, robot: RobotId, called: &str) -> Result<(), String> {
        let called: String = called.split_whitespace().collect::<Vec<_>>().join(" ");
        if called.chars().count() > CALLED_MAX || called.chars().any(char::is_control) {
            return Err(format!("A robot's name may have {CALLED_MAX} characters."));
        }
        let robot = robot.to_string();
        self.change(|kept| {
            let other = kept.robots.iter().find(|(id, about)| {
                **id != robot && !called.is_empty() && about.called.as_deref() == Some(&called)
            });
            if let Some((id, _)) = other {
                return Err(format!("Robot {id} is called {called} already: choose another name."));
            }
            let about = kept.robots.entry(robot).or_default();
            about.called = Some(called).filter(|called| !called.is_empty());
            Ok(())
        })
    }

    /// Puts robots on the list of the robots that may take part in runs, or takes them off (`listed` is false). The
    /// error is a line for people.
    pub fn list(&self, robots: &[RobotId], listed: bool) -> Result<(), String> {
        self.change(|kept| {
            for robot in robots {
                kept.robots.entry(robot.to_string()).or_default().listed = listed;
            }
            Ok(())
        })
    }

    /// Sets whether only listed robots take part in runs. If `on`, the robots in `present` are put on the list too. The
    /// error is a line for people.
    pub fn only_listed(&self, on: bool, present: &[RobotId]) -> Result<(), String> {
        self.change(|kept| {
            kept.only_listed = on;
            for robot in present.iter().filter(|_| on) {
                kept.robots.entry(robot.to_string()).or_default().listed = true;
            }
            Ok(())
        })
    }

    /// Whether only listed robots take part.
    pub fn is_only_listed(&self) -> bool {
        self.lock().only_listed
    }

    /// Returns the robots that may take part in runs; `None` if all may.
    pub fn admitted(&self) -> Option<BTreeSet<RobotId>> {
        let kept = self.lock();
        let listed = kept.robots.iter().filter(|(_, about)| about.listed);
        kept.only_listed.then(|| listed.filter_map(|(id, _)| RobotId::new(id)).collect())
    }

    /// Returns the display name of a robot, if it has one.
    pub fn called(&self, robot: RobotId) -> Option<String> {
        self.lock().robots.get(robot.as_str()).and_then(|about| about.called.clone())
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the content in memory and on the disk. After an error, the content in memory is unchanged.
    fn change(&self, act: impl FnOnce(&mut Kept) -> Result<(), String>) -> Result<(), String> {
        let mut kept = self.lock();
        let mut changed = kept.clone();
        act(&mut changed)?;
        changed.robots.retain(|_, about| *about != About::default());
        if changed.robots.len() > ROBOTS_MAX {
            return Err(format!("No more than {ROBOTS_MAX} robots are kept: take some off the list."));
        }
        if changed == *kept {
            return Ok(());
        }
        let text = serde_json::to_vec_pretty(&changed).map_err(|error| error.to_string())?;
        disk::replace(&self.path, &text, Readers::Owner)
            .map_err(|error| format!("{} cannot be written: {error}.", self.path.display()))?;
        *kept = changed;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lightbots-book-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn id(name: &str) -> RobotId {
        RobotId::new(name).unwrap()
    }

    #[test]
    fn names_and_the_list_come_back_at_the_next_start() {
        let folder = folder("back");
        let book = FleetBook::load(&folder);
        assert_eq!((book.admitted(), book.called(id("r1"))), (None, None));
        book.call(id("r1"), "  Anna   of the  left ").unwrap();
        book.only_listed(true, &[id("r1"), id("r2")]).unwrap();
        book.list(&[id("r2")], false).unwrap();
        let book = FleetBook::load(&folder);
        assert_eq!(book.called(id("r1")).as_deref(), Some("Anna of the left"));
        assert_eq!(book.admitted(), Some([id("r1")].into()));
        book.only_listed(false, &[]).unwrap();
        assert_eq!(FleetBook::load(&folder).admitted(), None);
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn two_robots_are_not_called_alike_and_a_name_has_an_end() {
        let folder = folder("alike");
        let book = FleetBook::load(&folder);
        book.call(id("r1"), "Anna").unwrap();
        assert!(book.call(id("r2"), "Anna").unwrap_err().contains("Robot r1"));
        book.call(id("r1"), "").unwrap();
        book.call(id("r2"), "Anna").unwrap();
        assert!(book.call(id("r2"), &"x".repeat(41)).is_err());
        assert_eq!(book.called(id("r2")).as_deref(), Some("Anna"));
        std::fs::remove_dir_all(folder).unwrap();
    }
}
