//! Errors of the MQTT client as messages for people.

use std::io::{self, ErrorKind};

use rumqttc::{ConnectReturnCode, ConnectionError, Error as MqttError, StateError, TlsError};
use tokio_rustls::rustls::{self, AlertDescription, CertificateError};

use crate::BrokerAddress;

/// Returns one line for people: why the connection to `address` failed or broke, and what to do. `accepted`: whether
/// the broker had accepted the login before the error.
pub(crate) fn reason(error: &ConnectionError, address: &BrokerAddress, accepted: bool) -> String {
    if let Some(error) = rustls_error(error) {
        return tls_reason(error, address);
    }
    if let Some(io) = io_error(error) {
        return io_reason(io, address, accepted);
    }
    match error {
        ConnectionError::MqttState(StateError::ConnectionAborted) => closed_reason(address, accepted),
        ConnectionError::MqttState(StateError::Deserialization(_)) | ConnectionError::NotConnAck(_)
            if !accepted =>
        {
            format!("what answers at {address} is no MQTT broker: {}", other_port(address))
        }
        ConnectionError::ConnectionRefused(
            ConnectReturnCode::BadUserNamePassword | ConnectReturnCode::NotAuthorized,
        ) => format!("the broker at {address} refuses this user and password: check both"),
        ConnectionError::ConnectionRefused(ConnectReturnCode::BadClientId) => {
            format!("the broker at {address} refuses our client id: allow LightBot/… and BotControl/… there")
        }
        ConnectionError::ConnectionRefused(code) => format!("the broker at {address} refuses us: {code:?}"),
        ConnectionError::NetworkTimeout | ConnectionError::FlushTimeout => {
            format!("the broker at {address} does not answer in time: check the address and the network")
        }
        ConnectionError::MqttState(StateError::AwaitPingResp) => {
            format!("the broker at {address} has fallen silent")
        }
        ConnectionError::Tls(TlsError::DNSName(_)) => {
            format!("{address} cannot be used with TLS: its host is no name and no address")
        }
        ConnectionError::Tls(TlsError::NoValidCertInChain) => {
            format!(
                "{address} cannot be used: this system trusts no authority; name the broker's own with --ca FILE"
            )
        }
        other => format!("the connection to {address} broke: {other}"),
    }
}

/// Returns one line for people about a subscription to the topic filter `filter` that the broker refused.
pub(crate) fn not_granted(filter: &str, address: &BrokerAddress) -> String {
    format!(
        "the broker at {address} refuses the subscription to {filter}: give this user the right to read it"
    )
}

fn io_reason(error: &io::Error, address: &BrokerAddress, accepted: bool) -> String {
    match error.kind() {
        ErrorKind::ConnectionRefused => {
            format!("no broker answers at {address}: start one there, or check the address")
        }
        ErrorKind::ConnectionReset
        | ErrorKind::ConnectionAborted
        | ErrorKind::UnexpectedEof
        | ErrorKind::BrokenPipe => closed_reason(address, accepted),
        _ => format!("the broker at {address} cannot be reached: {error}; check the address and the network"),
    }
}

fn closed_reason(address: &BrokerAddress, accepted: bool) -> String {
    if accepted {
        return format!("the broker at {address} closed the connection");
    }
    format!("the broker at {address} hung up before it answered: {}", other_port(address))
}

fn other_port(address: &BrokerAddress) -> &'static str {
    if address.tls {
        "is this its port for TLS (mqtt:// is the one without), and does it want a certificate of ours?"
    } else {
        "say mqtts:// where this is its port for TLS"
    }
}

/// The I/O error that caused `error`, or `None`.
fn io_error(error: &ConnectionError) -> Option<&io::Error> {
    match error {
        ConnectionError::Io(io)
        | ConnectionError::MqttState(StateError::Io(io) | StateError::Deserialization(MqttError::Io(io)))
        | ConnectionError::Tls(TlsError::Io(io)) => Some(io),
        _ => None,
    }
}

/// The error of the TLS library rustls that caused `error`, or `None`.
fn rustls_error(error: &ConnectionError) -> Option<&rustls::Error> {
    if let ConnectionError::Tls(TlsError::TLS(error)) = error {
        return Some(error);
    }
    io_error(error)?.get_ref()?.downcast_ref()
}

fn tls_reason(error: &rustls::Error, address: &BrokerAddress) -> String {
    match error {
        rustls::Error::InvalidCertificate(why) => certificate_reason(why, address),
        rustls::Error::AlertReceived(alert) => alert_reason(*alert, address),
        rustls::Error::InvalidMessage(_) => {
            format!("what answers at {address} does not speak TLS: {}", other_port(address))
        }
        other => format!("TLS with the broker at {address} failed: {other}"),
    }
}

fn certificate_reason(why: &CertificateError, address: &BrokerAddress) -> String {
    let broker = format!("the certificate of the broker at {address}");
    match why {
        CertificateError::UnknownIssuer | CertificateError::BadSignature => {
            format!("{broker} comes from no authority we trust: name its own with --ca FILE")
        }
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => {
            format!("{broker} has expired: give the broker a new one, or set this machine's clock")
        }
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            format!("{broker} is not valid yet: check the clocks of both machines")
        }
        CertificateError::NotValidForName => {
            format!("{broker} is made for other names than {}: use one of them", address.host)
        }
        CertificateError::NotValidForNameContext { presented, .. } => {
            let names: Vec<&str> = presented.iter().take(5).map(|name| bare_name(name)).collect();
            let names = if names.is_empty() { "no name".into() } else { names.join(", ") };
            format!(
                "{broker} is made for {names}, not for {}: use one of its names, or a certificate for this one",
                address.host
            )
        }
        other => format!("{broker} cannot be trusted: {other}"),
    }
}

/// Returns `a` for `DnsName("a")`, which is how rustls formats the names in a certificate.
fn bare_name(name: &str) -> &str {
    name.split_once('(').map_or(name, |(_, rest)| rest.trim_end_matches(')').trim_matches('"'))
}

fn alert_reason(alert: AlertDescription, address: &BrokerAddress) -> String {
    match alert {
        AlertDescription::CertificateRequired => {
            format!(
                "the broker at {address} wants to see a certificate of ours: name it with --client-cert and --client-key"
            )
        }
        AlertDescription::UnknownCA
        | AlertDescription::BadCertificate
        | AlertDescription::CertificateExpired
        | AlertDescription::CertificateRevoked
        | AlertDescription::CertificateUnknown
        | AlertDescription::UnsupportedCertificate
        | AlertDescription::AccessDenied
        | AlertDescription::DecryptError => format!(
            "the broker at {address} refuses our client certificate ({alert:?}): use one that its authority has signed"
        ),
        other => format!("the broker at {address} refuses TLS with us: {other:?}"),
    }
}
