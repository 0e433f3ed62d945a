//! Errors of the MQTT client in people's words.

use std::io::{self, ErrorKind};

use rumqttc::{ConnectReturnCode, ConnectionError, Error as MqttError, StateError, TlsError};
use tokio_rustls::rustls::{self, AlertDescription, CertificateError};

use crate::Place;

/// One line that says why there is no connection to `place`, and what to do. `greeted`: the broker had let us in.
pub(crate) fn reason(error: &ConnectionError, place: &Place, greeted: bool) -> String {
    if let Some(error) = rustls_error(error) {
        return tls_reason(error, place);
    }
    if let Some(io) = io_error(error) {
        return io_reason(io, place, greeted);
    }
    match error {
        ConnectionError::MqttState(StateError::ConnectionAborted) => hung_up(place, greeted),
        ConnectionError::MqttState(StateError::Deserialization(_)) | ConnectionError::NotConnAck(_)
            if !greeted =>
        {
            format!("what answers at {place} is no MQTT broker: {}", other_port(place))
        }
        ConnectionError::ConnectionRefused(
            ConnectReturnCode::BadUserNamePassword | ConnectReturnCode::NotAuthorized,
        ) => format!("the broker at {place} refuses this user and password: check both"),
        ConnectionError::ConnectionRefused(ConnectReturnCode::BadClientId) => {
            format!("the broker at {place} refuses our client id: allow LightBot/… and BotControl/… there")
        }
        ConnectionError::ConnectionRefused(code) => format!("the broker at {place} refuses us: {code:?}"),
        ConnectionError::NetworkTimeout | ConnectionError::FlushTimeout => {
            format!("the broker at {place} does not answer in time: check the address and the network")
        }
        ConnectionError::MqttState(StateError::AwaitPingResp) => {
            format!("the broker at {place} has fallen silent")
        }
        ConnectionError::Tls(TlsError::DNSName(_)) => {
            format!("{place} cannot be used with TLS: its host is no name and no address")
        }
        ConnectionError::Tls(TlsError::NoValidCertInChain) => {
            format!(
                "{place} cannot be used: this system trusts no authority; name the broker's own with --ca FILE"
            )
        }
        other => format!("the connection to {place} broke: {other}"),
    }
}

/// One line for a subscription that is not granted.
pub(crate) fn not_granted(filter: &str, place: &Place) -> String {
    format!("the broker at {place} refuses the subscription to {filter}: give this user the right to read it")
}

fn io_reason(error: &io::Error, place: &Place, greeted: bool) -> String {
    match error.kind() {
        ErrorKind::ConnectionRefused => {
            format!("no broker answers at {place}: start one there, or check the address")
        }
        ErrorKind::ConnectionReset
        | ErrorKind::ConnectionAborted
        | ErrorKind::UnexpectedEof
        | ErrorKind::BrokenPipe => hung_up(place, greeted),
        _ => format!("the broker at {place} cannot be reached: {error}; check the address and the network"),
    }
}

fn hung_up(place: &Place, greeted: bool) -> String {
    if greeted {
        return format!("the broker at {place} closed the connection");
    }
    format!("the broker at {place} hung up before it answered: {}", other_port(place))
}

fn other_port(place: &Place) -> &'static str {
    if place.tls {
        "is this its port for TLS (mqtt:// is the one without), and does it want a certificate of ours?"
    } else {
        "say mqtts:// where this is its port for TLS"
    }
}

/// What the system says, however deep it lies.
fn io_error(error: &ConnectionError) -> Option<&io::Error> {
    match error {
        ConnectionError::Io(io)
        | ConnectionError::MqttState(StateError::Io(io) | StateError::Deserialization(MqttError::Io(io)))
        | ConnectionError::Tls(TlsError::Io(io)) => Some(io),
        _ => None,
    }
}

/// What rustls says, however deep it lies.
fn rustls_error(error: &ConnectionError) -> Option<&rustls::Error> {
    if let ConnectionError::Tls(TlsError::TLS(error)) = error {
        return Some(error);
    }
    io_error(error)?.get_ref()?.downcast_ref()
}

fn tls_reason(error: &rustls::Error, place: &Place) -> String {
    match error {
        rustls::Error::InvalidCertificate(why) => certificate_reason(why, place),
        rustls::Error::AlertReceived(alert) => alert_reason(*alert, place),
        rustls::Error::InvalidMessage(_) => {
            format!("what answers at {place} does not speak TLS: {}", other_port(place))
        }
        other => format!("TLS with the broker at {place} failed: {other}"),
    }
}

fn certificate_reason(why: &CertificateError, place: &Place) -> String {
    let broker = format!("the certificate of the broker at {place}");
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
            format!("{broker} is made for other names than {}: use one of them", place.host)
        }
        CertificateError::NotValidForNameContext { presented, .. } => {
            let names: Vec<&str> = presented.iter().take(5).map(|name| bare_name(name)).collect();
            let names = if names.is_empty() { "no name".into() } else { names.join(", ") };
            format!(
                "{broker} is made for {names}, not for {}: use one of its names, or a certificate for this one",
                place.host
            )
        }
        other => format!("{broker} cannot be trusted: {other}"),
    }
}

/// `DnsName("a")` as rustls presents it, without its kind.
fn bare_name(name: &str) -> &str {
    name.split_once('(').map_or(name, |(_, rest)| rest.trim_end_matches(')').trim_matches('"'))
}

fn alert_reason(alert: AlertDescription, place: &Place) -> String {
    match alert {
        AlertDescription::CertificateRequired => {
            format!(
                "the broker at {place} wants to see a certificate of ours: name it with --client-cert and --client-key"
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
            "the broker at {place} refuses our client certificate ({alert:?}): use one that its authority has signed"
        ),
        other => format!("the broker at {place} refuses TLS with us: {other:?}"),
    }
}
