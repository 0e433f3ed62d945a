//! Saving and deleting shows.

use lightbots_api::{ShowEntry, ShowOrigin};
use lightbots_exchange::{ARCHIVE, LIGHTBOTS, Loaded, read, sniff};

use super::lock::lock;
use super::{Condition, Kept, Library, LibraryError, checked};

impl Library {
    /// Saves a show, given as the bytes of a file of any format. It is written in our format; a file that is only
    /// partly understood is kept byte for byte.
    ///
    /// Error if the present file of the show is only partly understood, or if `condition` does not hold. A built-in
    /// show is not changed: a copy is saved under a free name, which the entry states together with `copy_of`. With
    /// [`Condition::IsNew`], the name of a built-in show is a conflict.
    pub fn put(&self, name: &str, bytes: &[u8], condition: &Condition) -> Result<ShowEntry, LibraryError> {
        let name = checked(name)?;
        let loaded = read(bytes, None).map_err(|error| LibraryError::NoShow(error.to_string()))?;
        let _guard = lock(&self.writing);
        let given = self.given_show(name).filter(|_| *condition != Condition::IsNew);
        let now = self.get(name);
        if given.is_none() {
            check(name, condition, &now)?;
        }
        // A copy of a built-in show would lose what was not understood, too.
        if let Some(line) = now.ok().and_then(|kept| kept.read_only) {
            return Err(LibraryError::ReadOnly(line));
        }
        let target = given
            .as_ref()
            .map_or(name.to_owned(), |given| self.given.copy_name(&given.base, &self.files.names()));
        self.store(&target, bytes, &loaded).map_err(|error| {
            LibraryError::Disk(format!(
                "\"{target}\" cannot be saved in {}: {error}",
                self.files.folder().display()
            ))
        })?;
        let copy_of = given.map(|given| given.origin);
        let issues = loaded.issues.iter().map(Into::into).collect();
        Ok(ShowEntry { copy_of, issues, ..self.entry(&target)? })
    }

    fn store(&self, name: &str, bytes: &[u8], loaded: &Loaded) -> std::io::Result<()> {
        if loaded.unread.is_some() {
            let format = if sniff(bytes) == Some(&ARCHIVE) { &ARCHIVE } else { &LIGHTBOTS };
            self.keep_state(name, bytes);
            return self.files.replace(name, format, bytes);
        }
        // The assets are written first, so that no document lacks its assets.
        self.assets.keep(&loaded.show)?;
        let document = LIGHTBOTS.write(&loaded.show, None).bytes;
        self.keep_state(name, &document);
        self.files.replace(name, &LIGHTBOTS, &document)
    }

    /// Keeps the present file of a show as an earlier state, unless it equals `next`. A failure is only logged, so that
    /// the show is saved all the same.
    fn keep_state(&self, name: &str, next: &[u8]) {
        if self.files.read(name).is_ok_and(|now| now == next) {
            return;
        }
        if let Err(error) = self.states.keep(name, &self.files.present(name)) {
            tracing::warn!("an earlier state of \"{name}\" cannot be kept: {error}");
        }
    }

    /// Deletes a show of the folder. A built-in show cannot be deleted. Its last file becomes an earlier state. If the
    /// show was renamed, `renamed_to` is its new name, and gets the earlier states.
    pub fn delete(
        &self,
        name: &str,
        condition: &Condition,
        renamed_to: Option<&str>,
    ) -> Result<(), LibraryError> {
        let name = checked(name)?;
        let renamed_to = renamed_to.map(checked).transpose()?;
        let _guard = lock(&self.writing);
        if let Some(given) = self.given_show(name) {
            let what = match given.origin {
                ShowOrigin::StartFile => "is the file LightBots was started with",
                _ => "is an example",
            };
            let line = format!("\"{name}\" {what}, which cannot be deleted or renamed: save a copy instead");
            return Err(LibraryError::ReadOnly(line));
        }
        check(name, condition, &Ok(self.get(name)?))?;
        self.keep_state(name, &[]);
        if let Some(to) = renamed_to
            && let Err(error) = self.states.hand_over(name, to)
        {
            tracing::warn!("earlier states of \"{name}\" cannot become those of \"{to}\": {error}");
        }
        let removed = self.files.remove(name);
        removed.map_err(|error| LibraryError::Disk(format!("\"{name}\" cannot be deleted: {error}")))
    }
}

fn check(name: &str, condition: &Condition, now: &Result<Kept, LibraryError>) -> Result<(), LibraryError> {
    let conflict = |why: &str| Err(LibraryError::Conflict(format!("\"{name}\" {why}")));
    match (condition, now) {
        (Condition::Any, _) | (Condition::IsNew, Err(LibraryError::Missing(_))) => Ok(()),
        (Condition::IsNew, _) => conflict("is there already: choose another name"),
        (Condition::Is(wanted), Ok(now)) if *wanted == now.etag => Ok(()),
        (Condition::Is(_), _) => {
            conflict("was changed by somebody else: look at their version, or save under another name")
        }
    }
}
