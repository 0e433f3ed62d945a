//! The task that drives the MQTT client.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use rumqttc::{
    AsyncClient, Event, EventLoop, MqttOptions, Packet, QoS, SubscribeFilter, TlsConfiguration, Transport,
};
use tokio::sync::{mpsc, oneshot};

use crate::BrokerUrl;
use crate::backoff::Backoff;
use crate::link::{LinkConfig, LinkEvent, Shared};
use crate::reason::reason;

/// No message of the protocol is nearly as long; one that is longer costs the connection.
const LONGEST_PACKET: usize = 16 << 20;
/// A packet of subscriptions stays far below every broker's limit.
const FILTERS_A_PACKET: usize = 100;
const GOODBYE: Duration = Duration::from_millis(500);

pub(crate) struct Pump {
    broker: BrokerUrl,
    filters: Vec<String>,
    client: AsyncClient,
    connection: EventLoop,
    events: mpsc::Sender<LinkEvent>,
    stop: oneshot::Receiver<()>,
    shared: Arc<Shared>,
    backoff: Backoff,
    /// Subscription packets not yet acknowledged since the last connect.
    unconfirmed: usize,
    /// What was said last about a missing connection.
    last_reason: Option<String>,
}

type Parts = (AsyncClient, Pump, mpsc::Receiver<LinkEvent>, oneshot::Sender<()>);

impl Pump {
    pub(crate) fn new(config: LinkConfig, shared: Arc<Shared>) -> Parts {
        let queue = config.queue.max(16);
        let (client, mut connection) = AsyncClient::builder(options(&config)).capacity(queue).build();
        let mut network = connection.network_options();
        network.set_tcp_nodelay(true);
        network.set_connection_timeout(5);
        connection.set_network_options(network);
        let (events, receiver) = mpsc::channel(queue);
        let (stopper, stop) = oneshot::channel();
        let pump = Self {
            broker: config.broker,
            filters: config.filters,
            client: client.clone(),
            connection,
            events,
            stop,
            shared,
            backoff: Backoff::new(),
            unconfirmed: 0,
            last_reason: None,
        };
        (client, pump, receiver, stopper)
    }

    /// Runs until the link is closed or dropped.
    pub(crate) async fn run(mut self) {
        loop {
            let polled = tokio::select! {
                biased;
                _ = &mut self.stop => break,
                polled = self.connection.poll() => polled,
            };
            let going_on = match polled {
                Ok(Event::Incoming(packet)) => self.incoming(packet).await,
                Ok(Event::Outgoing(_)) => true,
                Err(error) => self.failed(&reason(&error, &self.broker)).await,
            };
            if !going_on {
                break;
            }
        }
        self.goodbye().await;
    }

    async fn incoming(&mut self, packet: Packet) -> bool {
        match packet {
            Packet::ConnAck(answer) => {
                self.backoff.reset();
                if !answer.session_present && !self.filters.is_empty() {
                    self.subscribe();
                    return true;
                }
                self.connected().await
            }
            Packet::SubAck(_) if self.unconfirmed > 0 => {
                self.unconfirmed -= 1;
                if self.unconfirmed > 0 {
                    return true;
                }
                self.connected().await
            }
            Packet::Publish(message) => {
                let Ok(topic) = String::from_utf8(message.topic.to_vec()) else { return true };
                let payload = message.payload.to_vec();
                if self.events.try_send(LinkEvent::Message { topic, payload }).is_err() {
                    self.shared.dropped.fetch_add(1, Ordering::Relaxed);
                }
                !self.events.is_closed()
            }
            _ => true,
        }
    }

    fn subscribe(&mut self) {
        self.unconfirmed = 0;
        for filters in self.filters.chunks(FILTERS_A_PACKET) {
            let filters = filters.iter().map(|filter| SubscribeFilter::new(filter.clone(), QoS::AtMostOnce));
            match self.client.try_subscribe_many(filters) {
                Ok(()) => self.unconfirmed += 1,
                Err(error) => tracing::error!("cannot subscribe on {}: {error}", self.broker),
            }
        }
    }

    async fn connected(&mut self) -> bool {
        tracing::info!("connected to {}", self.broker);
        self.last_reason = None;
        self.shared.connected.store(true, Ordering::Release);
        self.events.send(LinkEvent::Connected).await.is_ok()
    }

    /// The connection failed: says so where that is news, then waits for the next attempt.
    async fn failed(&mut self, reason: &str) -> bool {
        self.shared.connected.store(false, Ordering::Release);
        // What was to be sent on the old connection is stale on the next.
        self.connection.reset_session_state();
        if self.last_reason.as_deref() != Some(reason) {
            tracing::warn!("{reason}");
            self.last_reason = Some(reason.to_owned());
            let event = LinkEvent::Disconnected { reason: reason.to_owned() };
            if self.events.send(event).await.is_err() {
                return false;
            }
        }
        let mut random = [0; 4];
        // Without randomness the wait is merely not spread.
        let _ = getrandom::fill(&mut random);
        let wait = self.backoff.wait(u32::from_le_bytes(random));
        tokio::select! {
            _ = &mut self.stop => false,
            () = self.events.closed() => false,
            () = tokio::time::sleep(wait) => true,
        }
    }

    /// Flushes what was sent and leaves, within [`GOODBYE`].
    async fn goodbye(mut self) {
        if !self.shared.connected.swap(false, Ordering::AcqRel) || self.client.try_disconnect().is_err() {
            return;
        }
        let flush = async { while self.connection.poll().await.is_ok() {} };
        // A broker that does not take it in time loses the connection without a goodbye.
        let _ = tokio::time::timeout(GOODBYE, flush).await;
    }
}

fn options(config: &LinkConfig) -> MqttOptions {
    let broker = &config.broker;
    let mut options = MqttOptions::new(config.client_id.clone(), (broker.host.clone(), broker.port));
    options.set_keep_alive(15).set_max_packet_size(LONGEST_PACKET, LONGEST_PACKET).set_inflight(1000);
    if let Some(user) = &broker.user {
        options.set_credentials(user.clone(), broker.password.clone().unwrap_or_default());
    }
    if broker.tls {
        match TlsConfiguration::try_default_rustls() {
            Ok(tls) => {
                options.set_transport(Transport::tls_with_config(tls));
            }
            Err(error) => tracing::error!("the system's certificates cannot be read: {error}"),
        }
    }
    options
}
