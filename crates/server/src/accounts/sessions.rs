//! Sessions of people. They are kept in memory only, so a restart of the program ends them.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::Secret;

/// Longest time from sign-in to the end of a session: a long day of rehearsal and show. A sign-out or a new password ends
/// the session earlier.
pub const SESSION_LASTS: Duration = Duration::from_secs(12 * 3600);
/// Most sessions at once. A further sign-in ends the oldest one.
const MOST: usize = 1_000;

/// Sessions by the hash of their tokens.
#[derive(Debug, Default)]
pub struct Sessions(Mutex<BTreeMap<Secret, Session>>);

#[derive(Clone, Debug)]
struct Session {
    person: String,
    /// The hash of the password at sign-in. A changed password ends the session.
    password: String,
    ends: Instant,
}

impl Sessions {
    /// Begins a session and returns its token. `password` is the hash of the person's password. If there are [`MOST`]
    /// sessions already, ends the one that began first.
    pub fn begin(&self, person: &str, password: &str, now: Instant) -> Result<String, String> {
        let (token, hash) = Secret::fresh()?;
        let mut sessions = self.lock();
        sessions.retain(|_, session| session.ends > now);
        if sessions.len() >= MOST {
            let oldest = sessions.iter().min_by_key(|(_, session)| session.ends);
            let oldest = oldest.map(|(hash, _)| hash.clone());
            oldest.and_then(|hash| sessions.remove(&hash));
        }
        let ends = now + SESSION_LASTS;
        sessions.insert(hash, Session { person: person.to_owned(), password: password.to_owned(), ends });
        Ok(token)
    }

    /// Returns the person and the password hash of the session whose token has the hash `session`. `None` if there is no
    /// such session, or if it has ended.
    pub fn find(&self, session: &Secret, now: Instant) -> Option<(String, String)> {
        let sessions = self.lock();
        let found = sessions.get(session).filter(|session| now < session.ends)?;
        Some((found.person.clone(), found.password.clone()))
    }

    /// Ends a session.
    pub fn end(&self, session: &Secret) {
        self.lock().remove(session);
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<Secret, Session>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_ends_at_its_time_and_at_sign_out() {
        let (sessions, began) = (Sessions::default(), Instant::now());
        let token = sessions.begin("ann", "hash", began).unwrap();
        let (session, other) = (Secret::of(&token), Secret::of("other"));
        let last = began + SESSION_LASTS - Duration::from_millis(1);
        assert_eq!(sessions.find(&session, last), Some(("ann".into(), "hash".into())));
        assert_eq!(sessions.find(&session, began + SESSION_LASTS), None);
        assert_eq!(sessions.find(&other, began), None);
        sessions.end(&session);
        assert_eq!(sessions.find(&session, began), None);
    }

    #[test]
    fn sessions_are_bounded_and_the_oldest_one_ends() {
        let (sessions, began) = (Sessions::default(), Instant::now());
        let first = sessions.begin("ann", "hash", began).unwrap();
        let second = sessions.begin("ann", "hash", began + Duration::from_secs(1)).unwrap();
        for _ in 1..MOST {
            sessions.begin("bob", "hash", began + Duration::from_secs(2)).unwrap();
        }
        assert_eq!(sessions.find(&Secret::of(&first), began), None);
        assert!(sessions.find(&Secret::of(&second), began).is_some());
    }
}
