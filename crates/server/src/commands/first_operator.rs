//! The one-time address at which the first operator chooses a name and a password.

use qrcode::QrCode;
use qrcode::render::unicode::Dense1x2;

use crate::say;

/// Prints the address with the token, as text and as a QR code for a phone. The token is behind `#`, so that browsers
/// do not send it with the request of the page and no log holds it.
pub fn invite(address: &str, token: &str) {
    let url = format!("{address}/#first={token}");
    say::line(&format!("There are no accounts yet. Make the first operator at {url}"));
    if let Ok(code) = QrCode::new(&url) {
        say::line(&code.render::<Dense1x2>().build());
    }
}
