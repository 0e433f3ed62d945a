//! `broker`: the embedded broker alone.

use crate::cli::{BrokerOnlyArguments, MqttArguments};
use crate::failure::{Failure, Outcome};
use crate::live::broker::{self, BrokerOptions, Engine, TlsOptions, Users};
use crate::stop::Stop;
use crate::{open_files, say};

pub async fn run(arguments: BrokerOnlyArguments, stop: Stop) -> Outcome {
    // Ctrl-C at the terminal reaches parent and child. The child does not end by it, but when its parent closes the
    // pipe, so that robots still receive STOP.
    stop.take_over();
    open_files::raise_limit();
    open_files::limit_memory();
    if arguments.child {
        return broker::child().await;
    }
    let mut engine = Engine::start(options(&arguments.mqtt, arguments.robots as usize)?)?;
    say::line(&format!("Broker mqtt://{} (Ctrl-C stops it)", engine.address()));
    if let Some(tls) = engine.tls_address() {
        say::line(&format!("Broker with TLS mqtts://{tls}"));
    }
    // The receiver is kept but not read, because each notice is logged too.
    let notices = engine.notices();
    stop.wait().await;
    drop(notices);
    Ok(true)
}

/// Reads the settings of the embedded broker from the command line.
pub fn options(arguments: &MqttArguments, robots: usize) -> Result<BrokerOptions, Failure> {
    let users = Users::read(&arguments.mqtt_user, arguments.mqtt_users.as_deref())?;
    Ok(BrokerOptions { listen: arguments.mqtt_listen, tls: tls_options(arguments), users, robots })
}

fn tls_options(arguments: &MqttArguments) -> Option<TlsOptions> {
    let (cert, key) = (arguments.cert.clone()?, arguments.key.clone()?);
    let client_ca = arguments.client_ca.clone();
    Some(TlsOptions { listen: arguments.mqtt_tls_listen?, cert, key, client_ca })
}
