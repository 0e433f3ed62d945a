//! Sign-in, people and tokens over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `POST /api/session` | [`Credentials`] | 204 and the cookie of a session; 401 for a wrong name or password, 429 with
//! `Retry-After` after too many wrong passwords |
//! | `POST /api/first` | [`FirstOperator`] | 204 and the cookie of a session: makes the first operator |
//! | `GET /api/session` | | [`Whoami`] |
//! | `DELETE /api/session` | | 204: ends the session of the cookie; a token stays |
//! | `GET /api/people` | | list of [`AccountEntry`], by name |
//! | `POST /api/people` | [`NewPerson`] | 204; 409 for a name that is taken |
//! | `PUT /api/people/{name}` | [`PersonChange`] | 204; 409 for the last operator, because one must stay |
//! | `DELETE /api/people/{name}` | | 204: the person's sessions and tokens end within a second; 409 for the last operator |
//! | `GET /api/tokens` | | list of [`AccountEntry`], by name |
//! | `POST /api/tokens` | [`AccountEntry`] | [`MadeToken`], the only answer that holds the token; 409 for a name that is
//! taken |
//! | `DELETE /api/tokens/{name}` | | 204: the token is no longer valid |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// What a person or a program may do. A greater role may do all that a smaller one may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "lowercase")]
pub enum AccountRole {
    /// Watch shows, and stop all robots.
    Viewer,
    /// Change shows, and open a show on every screen.
    Editor,
    /// Run shows.
    Operator,
}

impl AccountRole {
    /// Every role, the smallest first.
    pub const ALL: [Self; 3] = [Self::Viewer, Self::Editor, Self::Operator];

    /// The role's name in messages and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Viewer => "viewer",
            Self::Editor => "editor",
            Self::Operator => "operator",
        }
    }
}

impl std::fmt::Display for AccountRole {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name())
    }
}

impl std::str::FromStr for AccountRole {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|role| role.name() == text);
        found.ok_or_else(|| "a role is viewer, editor or operator".into())
    }
}

/// Name and password of a person.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Credentials {
    /// Name of the person.
    pub name: String,
    /// Password of the person.
    pub password: String,
}

/// The first operator, with the one-time token that the program printed when it started without people.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct FirstOperator {
    /// The one-time token.
    pub token: String,
    /// Name of the operator: 1 to 32 letters, digits and `-` `_` `.`.
    pub name: String,
    /// Password of the operator: at least 8 characters, at most 256 bytes.
    pub password: String,
}

/// The person or program that sent a request.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Whoami {
    /// Name of the person or the token; null on loopback, where no sign-in is needed.
    pub name: Option<String>,
    /// The role of the person or the token now.
    pub role: AccountRole,
}

/// A person or a token.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct AccountEntry {
    /// Name: 1 to 32 letters, digits and `-` `_` `.`.
    pub name: String,
    /// What the person or the token may do.
    pub role: AccountRole,
}

/// A new token of a program.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct MadeToken {
    /// Name of the token.
    pub name: String,
    /// What the token may do. A token never allows more than the present role of the person that made the token.
    pub role: AccountRole,
    /// The token itself, for the header `Authorization: Bearer TOKEN`. The server keeps only a hash of it.
    pub token: String,
}

/// A person to be added.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct NewPerson {
    /// Name: 1 to 32 letters, digits and `-` `_` `.`.
    pub name: String,
    /// What the person may do.
    pub role: AccountRole,
    /// Password of the person: at least 8 characters, at most 256 bytes.
    pub password: String,
}

/// A change of the role or password of a person.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct PersonChange {
    /// The new role; null: as before.
    #[ts(optional = nullable)]
    pub role: Option<AccountRole>,
    /// The new password, which ends the sessions of the person; null: as before.
    #[ts(optional = nullable)]
    pub password: Option<String>,
}
