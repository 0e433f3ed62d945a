//! Secrets, and how they are kept: passwords by argon2, random tokens by SHA-256.

use argon2::Argon2;
use argon2::password_hash::{PasswordHash, PasswordHasher, PasswordVerifier, SaltString};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Random bytes of a token: 256 bits, which cannot be guessed.
const TOKEN_BYTES: usize = 32;
/// Random bytes of a salt (RFC 9106, section 3.1).
const SALT_BYTES: usize = 16;

/// The hash of a random token. A fast hash is enough, because a token of 256 random bits cannot be guessed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Secret(String);

impl Secret {
    /// The hash of a token.
    pub fn of(token: &str) -> Self {
        Self(hex(&Sha256::digest(token.as_bytes())))
    }

    /// Makes a random token. Returns the token and its hash. Error if the system gives no random numbers.
    pub fn fresh() -> Result<(String, Self), String> {
        let mut bytes = [0; TOKEN_BYTES];
        random(&mut bytes)?;
        let token = hex(&bytes);
        let hash = Self::of(&token);
        Ok((token, hash))
    }
}

/// Hashes a password by Argon2id with the default parameters of the crate: 19 MiB and two passes, the least that OWASP
/// recommends.
pub fn hash_password(password: &str) -> Result<String, String> {
    let mut salt = [0; SALT_BYTES];
    random(&mut salt)?;
    let salt = SaltString::encode_b64(&salt).map_err(|error| error.to_string())?;
    let hash = Argon2::default().hash_password(password.as_bytes(), &salt);
    hash.map(|hash| hash.to_string()).map_err(|error| error.to_string())
}

/// Whether the password has this hash, a text in PHC string format. `false` if the text is invalid.
pub fn is_password(password: &str, hash: &str) -> bool {
    let Ok(hash) = PasswordHash::new(hash) else { return false };
    Argon2::default().verify_password(password.as_bytes(), &hash).is_ok()
}

fn random(bytes: &mut [u8]) -> Result<(), String> {
    getrandom::fill(bytes).map_err(|error| format!("the system gives no random numbers: {error}"))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_password_has_its_hash_and_no_other() {
        let hash = hash_password("correct horse").unwrap();
        assert!(is_password("correct horse", &hash));
        assert!(!is_password("correct horsf", &hash) && !is_password("correct horse", "nonsense"));
        assert_ne!(hash, hash_password("correct horse").unwrap(), "each hash has a salt of its own");
    }
}
