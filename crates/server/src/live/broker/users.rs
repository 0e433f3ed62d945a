//! Users of the embedded broker.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::failure::Failure;

/// Users by name. If there are none, clients on this machine may connect without login, and over TLS also other clients with
/// a certificate of the authority.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Users(BTreeMap<String, User>);

/// One user.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct User {
    password: String,
    role: Role,
}

/// The role of a user: which clients the user may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Role {
    /// A robot if the client id is `LightBot/<name>`, a controller if it is `BotControl/<name>`. With any other client id,
    /// the same as [`Role::Fleet`].
    #[default]
    ByClientId,
    /// A controller: may subscribe to everything, and publish everything, commands such as STOP included.
    Controller,
    /// May subscribe to everything, and publish everything but commands and GO: for connections that many robots share,
    /// and for tools that watch.
    Fleet,
    /// May publish GO for frames that wait for it, and do nothing else: for a pedal or a desk.
    Cue,
    /// The robot with the user's name, and no other.
    Robot,
    /// Any robot. The client id names it, and each connection has one robot. For robots that share a password.
    AnyRobot,
}

/// Roles by their words in the text of a user. [`Role::ByClientId`] has no word.
const ROLES: [(&str, Role); 5] = [
    ("controller", Role::Controller),
    ("fleet", Role::Fleet),
    ("cue", Role::Cue),
    ("robot", Role::Robot),
    ("any-robot", Role::AnyRobot),
];

impl Users {
    /// Reads users from options (`user:password[:role]`), and from a file with one user a line. Lines that begin with
    /// `#` are remarks. The failure is one line that repeats no password.
    pub fn read(options: &[String], file: Option<&Path>) -> Result<Self, Failure> {
        let mut users = Self::default();
        for text in options {
            users.add(text).map_err(|why| Failure::input(format!("--mqtt-user: {why}")))?;
        }
        let Some(path) = file else { return Ok(users) };
        let name = path.display();
        let text = std::fs::read_to_string(path)
            .map_err(|error| Failure::input(format!("the users in {name} cannot be read: {error}")))?;
        warn_if_open(path);
        for (number, line) in text.lines().enumerate() {
            let line = line.trim();
            if !line.is_empty() && !line.starts_with('#') {
                users
                    .add(line)
                    .map_err(|why| Failure::input(format!("{name} line {}: {why}", number + 1)))?;
            }
        }
        if users.is_empty() {
            return Err(Failure::input(format!(
                "{name} names no user: say user:password[:role], one a line"
            )));
        }
        Ok(users)
    }

    /// Adds a user. A user of the same name is replaced.
    pub fn with(mut self, name: &str, password: &str, role: Role) -> Self {
        self.0.insert(name.to_owned(), User { password: password.to_owned(), role });
        self
    }

    /// Whether there are no users.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the role of a user; `None` if name or password is wrong.
    pub fn login(&self, name: &str, password: &[u8]) -> Option<Role> {
        let user = self.0.get(name)?;
        is_same(user.password.as_bytes(), password).then_some(user.role)
    }

    /// Returns the role of a user that has logged in; the default role for an unknown name.
    pub fn role(&self, name: &str) -> Role {
        self.0.get(name).map_or(Role::default(), |user| user.role)
    }

    /// Adds the user of a text `user:password[:role]`. `Err`: a line that says what is wrong and repeats no password.
    fn add(&mut self, text: &str) -> Result<(), String> {
        let wrong = || "say user:password or user:password:role, user and password not empty".to_owned();
        let (name, rest) = text.split_once(':').ok_or_else(wrong)?;
        let role = ROLES.iter().find_map(|(word, role)| {
            let password = rest.strip_suffix(word)?.strip_suffix(':')?;
            Some((password, *role))
        });
        let (password, role) = role.unwrap_or((rest, Role::default()));
        if name.is_empty() || password.is_empty() {
            return Err(wrong());
        }
        if self.0.contains_key(name) {
            return Err(format!("the user {name} is named twice"));
        }
        let user = User { password: password.to_owned(), role };
        self.0.insert(name.to_owned(), user);
        Ok(())
    }
}

/// Whether two passwords are equal. Takes the same time for every wrong password of the right length.
fn is_same(one: &[u8], other: &[u8]) -> bool {
    one.len() == other.len() && one.iter().zip(other).fold(0, |differs, (a, b)| differs | (a ^ b)) == 0
}

/// Logs a warning if other users of this machine can read the passwords in a file.
fn warn_if_open(path: &Path) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(path).map_or(0, |about| about.permissions().mode());
        if mode & 0o077 != 0 {
            tracing::warn!(
                "others on this machine can read the passwords in {0}: chmod 600 {0}",
                path.display()
            );
        }
    }
    #[cfg(not(unix))]
    let _ = path;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn users_have_roles_and_passwords_may_hold_colons() {
        let options =
            ["a:b", "me:x:y:controller", "r1:p:robot", "default:default:any-robot"].map(str::to_owned);
        let users = Users::read(&options, None).unwrap();
        assert_eq!(users.login("a", b"b"), Some(Role::ByClientId));
        assert_eq!(users.login("me", b"x:y"), Some(Role::Controller));
        assert_eq!(users.login("r1", b"p"), Some(Role::Robot));
        assert_eq!(users.role("default"), Role::AnyRobot);
        for (name, password) in [("a", "c"), ("a", ""), ("a", "bb"), ("b", "b"), ("", "")] {
            assert_eq!(users.login(name, password.as_bytes()), None);
        }
    }

    #[test]
    fn what_is_no_user_is_said_without_its_password() {
        for text in ["me", ":secret", "me:", "me::robot"] {
            let error = Users::read(&[text.to_owned()], None).unwrap_err();
            assert_eq!(error.code, 2);
            assert!(error.line.contains("--mqtt-user") && !error.line.contains("secret"), "{}", error.line);
        }
        assert!(Users::read(&["a:b".into(), "a:c".into()], None).unwrap_err().line.contains("twice"));
    }

    #[test]
    fn a_file_of_users_is_read_line_by_line() {
        let path = std::env::temp_dir().join(format!("lightbots-users-{}", std::process::id()));
        std::fs::write(&path, "# who\n\nstage:s3:controller\nr1:p:robot\n").unwrap();
        let users = Users::read(&[], Some(&path)).unwrap();
        assert_eq!((users.role("stage"), users.role("r1")), (Role::Controller, Role::Robot));
        std::fs::write(&path, "stage:s3\nnonsense\n").unwrap();
        assert!(Users::read(&[], Some(&path)).unwrap_err().line.contains("line 2"));
        std::fs::write(&path, "# nobody\n").unwrap();
        assert!(Users::read(&[], Some(&path)).unwrap_err().line.contains("names no user"));
        std::fs::remove_file(&path).unwrap();
        assert!(Users::read(&[], Some(&path)).unwrap_err().line.contains("cannot be read"));
    }
}
