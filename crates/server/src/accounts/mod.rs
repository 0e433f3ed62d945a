//! People and programs that may use the web app, kept in one file of the data folder. The file is read anew each time,
//! because `lightbots passwd` changes it while a server runs.

mod hash_thread;
mod secret;
mod sessions;
mod tries;

use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use lightbots_api::AccountRole;
use serde::{Deserialize, Serialize};

pub use hash_thread::HashThread;
pub use secret::{Secret, hash_password, is_password};
pub use sessions::{SESSION_LASTS, Sessions};
pub use tries::{SignInTries, TriesLeft};

use crate::disk::{self, Readers};

/// Name of the file in the data folder.
const FILE: &str = "accounts.json";
/// Name of the file that is locked while the accounts are changed, so that no change of another process is lost.
const LOCK: &str = ".accounts-lock";
/// Longest file that is read, bytes; enough for thousands of people.
const FILE_MAX: u64 = 1 << 20;
/// Longest name of a person or a token, characters.
const NAME_MAX: usize = 32;
/// Fewest characters of a password: NIST SP 800-63B (revision 3), section 5.1.1.1.
const PASSWORD_MIN: usize = 8;
/// Longest password, bytes. Bounds the work of hashing.
const PASSWORD_MAX: usize = 256;

/// A person with a password.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Person {
    pub role: AccountRole,
    /// The hash in PHC string format, with salt and parameters.
    pub password: String,
}

/// A token of a program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ApiToken {
    pub role: AccountRole,
    /// The hash of the token.
    pub hash: Secret,
    /// Name of the person that made the token. The token ends with that person's account, and never allows more than the
    /// person's role. `None` if the token was made while no sign-in was required.
    #[serde(default)]
    pub maker: Option<String>,
}

/// Content of the accounts file: people and tokens by their names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AccountList {
    pub people: BTreeMap<String, Person>,
    #[serde(default)]
    pub tokens: BTreeMap<String, ApiToken>,
}

impl AccountList {
    /// Returns the role that a token has at present: the lower of its own role and its maker's. `None` if its maker has no
    /// account any more.
    pub fn role_of(&self, token: &ApiToken) -> Option<AccountRole> {
        let Some(maker) = &token.maker else { return Some(token.role) };
        self.people.get(maker).map(|person| person.role.min(token.role))
    }

    /// Whether a person is the only operator.
    pub fn is_last_operator(&self, name: &str) -> bool {
        let mut operators = self.people.iter().filter(|(_, person)| person.role == AccountRole::Operator);
        operators.next().is_some_and(|(only, _)| only == name) && operators.next().is_none()
    }

    /// Removes a person and the tokens that the person made. Returns whether the person existed.
    pub fn remove(&mut self, name: &str) -> bool {
        self.tokens.retain(|_, token| token.maker.as_deref() != Some(name));
        self.people.remove(name).is_some()
    }
}

/// The file of accounts.
#[derive(Clone, Debug)]
pub struct Accounts {
    data: PathBuf,
}

impl Accounts {
    /// Returns the accounts of a data folder. Nothing is read yet.
    pub fn of(data: &Path) -> Self {
        Self { data: data.to_owned() }
    }

    /// Reads the file; a missing file gives an empty list. A file that cannot be read is an error, because an empty
    /// list would let the next start invite a first operator.
    pub fn read(&self) -> Result<AccountList, String> {
        let path = self.data.join(FILE);
        let failed = |error: &dyn std::fmt::Display| {
            format!(
                "the accounts in {} cannot be read: {error}; restore the file from a backup",
                path.display()
            )
        };
        match disk::read_regular(&path, FILE_MAX) {
            Ok(bytes) => serde_json::from_slice(&bytes).map_err(|error| failed(&error)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(AccountList::default()),
            Err(error) => Err(failed(&error)),
        }
    }

    /// Reads the file, applies `change` and writes the file, under a lock. If `change` returns an error, the file stays
    /// as it was.
    pub fn change<T>(&self, change: impl FnOnce(&mut AccountList) -> Result<T, String>) -> Result<T, String> {
        let failed = |error: std::io::Error| {
            format!("accounts cannot be kept in {}: {error}; free or repair the disk", self.data.display())
        };
        disk::create_folder(&self.data).map_err(failed)?;
        let lock = OpenOptions::new().write(true).create(true).truncate(false).open(self.data.join(LOCK));
        let lock = lock.map_err(failed)?;
        lock.lock().map_err(failed)?;
        let mut list = self.read()?;
        let done = change(&mut list)?;
        let text = serde_json::to_vec_pretty(&list).map_err(|error| error.to_string())?;
        disk::replace(&self.data.join(FILE), &text, Readers::Owner).map_err(failed)?;
        Ok(done)
    }
}

/// Checks the name of a person or a token: 1 to [`NAME_MAX`] letters, digits, `-`, `_` or `.`. The error is a sentence for
/// people.
pub fn check_name(name: &str) -> Result<(), String> {
    let fits = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.');
    if (1..=NAME_MAX).contains(&name.chars().count()) && name.chars().all(fits) {
        return Ok(());
    }
    Err(format!("A name has 1 to {NAME_MAX} letters, digits and - _ . without spaces."))
}

/// Checks that a password is neither too short nor too long. The error is a sentence for people.
pub fn check_password(password: &str) -> Result<(), String> {
    if password.chars().count() < PASSWORD_MIN {
        return Err(format!("A password has at least {PASSWORD_MIN} characters."));
    }
    if password.len() > PASSWORD_MAX {
        return Err(format!("A password has at most {PASSWORD_MAX} bytes."));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accounts_are_for_their_owner_only_and_damage_is_no_empty_list() {
        let data = std::env::temp_dir().join(format!("lightbots-accounts-{}", std::process::id()));
        let accounts = Accounts::of(&data);
        assert_eq!(accounts.read(), Ok(AccountList::default()));
        let person =
            Person { role: AccountRole::Editor, password: hash_password("a long password").unwrap() };
        accounts
            .change(|list| {
                list.people.insert("ann".into(), person.clone());
                Ok(())
            })
            .unwrap();
        assert_eq!(accounts.read().unwrap().people["ann"], person);
        assert_eq!(accounts.change(|_| Err::<(), _>("no".into())), Err("no".into()));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = std::fs::metadata(data.join(FILE)).unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600);
        }
        let text = std::fs::read_to_string(data.join(FILE)).unwrap();
        assert!(!text.contains("a long password") && text.contains("$argon2id$"), "{text}");
        std::fs::write(data.join(FILE), b"{").unwrap();
        assert!(accounts.read().unwrap_err().contains("backup"));
        std::fs::remove_dir_all(data).unwrap();
    }

    #[test]
    fn roles_contain_each_other() {
        assert!(AccountRole::Viewer < AccountRole::Editor && AccountRole::Editor < AccountRole::Operator);
    }
}
