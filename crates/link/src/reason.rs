//! Errors of the MQTT client in people's words.

use std::io::ErrorKind;

use rumqttc::{ConnectReturnCode, ConnectionError};

use crate::BrokerUrl;

/// One line that says why there is no connection to `broker`, and what to do.
pub(crate) fn reason(error: &ConnectionError, broker: &BrokerUrl) -> String {
    match error {
        ConnectionError::Io(io) if io.kind() == ErrorKind::ConnectionRefused => {
            format!("no broker answers at {broker}: start one there, or check the address")
        }
        ConnectionError::Io(io) if is_cut(io.kind()) => {
            format!("the broker at {broker} closed the connection")
        }
        ConnectionError::Io(io) => format!("the broker at {broker} cannot be reached: {io}"),
        ConnectionError::ConnectionRefused(
            ConnectReturnCode::BadUserNamePassword | ConnectReturnCode::NotAuthorized,
        ) => format!("the broker at {broker} refuses this user and password"),
        ConnectionError::ConnectionRefused(code) => format!("the broker at {broker} refuses us: {code:?}"),
        ConnectionError::NetworkTimeout | ConnectionError::FlushTimeout => {
            format!("the broker at {broker} does not answer in time")
        }
        other => format!("the connection to {broker} broke: {other}"),
    }
}

fn is_cut(kind: ErrorKind) -> bool {
    matches!(
        kind,
        ErrorKind::ConnectionReset
            | ErrorKind::ConnectionAborted
            | ErrorKind::UnexpectedEof
            | ErrorKind::BrokenPipe
    )
}
