//! The task that drives the MQTT client.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use rumqttc::{
    AsyncClient, Event, EventLoop, MqttOptions, Packet, QoS, SubAck, SubscribeFilter, SubscribeReasonCode,
    TlsConfiguration, Transport,
};
use tokio::sync::{mpsc, oneshot};
use tokio::task::AbortHandle;

use crate::backoff::Backoff;
use crate::link::{LinkConfig, LinkEvent, Shared};
use crate::reason::{not_granted, reason};
use crate::stream::Mouth;
use crate::{Place, Trust};

/// No message of the protocol is nearly as long; one that is longer costs the connection.
const LONGEST_PACKET: usize = 16 << 20;
/// A packet of subscriptions stays far below every broker's limit.
const FILTERS_A_PACKET: usize = 100;
const GOODBYE: Duration = Duration::from_millis(500);
/// After a reconnect the subscriptions are said again so much later each time: a cluster that has just lost a node may
/// still be clearing away what it knew of that node's clients, under the same names.
const SUBSCRIBE_AGAIN: [Duration; 3] =
    [Duration::from_millis(1_000), Duration::from_millis(2_000), Duration::from_millis(6_000)];
/// The next address is tried within this time, at random, so that a fleet does not knock there at once.
const NEXT_PLACE: Duration = Duration::from_millis(100);

pub(crate) struct Pump {
    config: LinkConfig,
    client: AsyncClient,
    connection: EventLoop,
    mouth: Mouth,
    events: mpsc::Sender<LinkEvent>,
    stop: oneshot::Receiver<()>,
    shared: Arc<Shared>,
    backoff: Backoff,
    /// Which address is used or tried.
    at: usize,
    /// Addresses that failed one after the other.
    failures: usize,
    /// Whether the broker has let us in on this connection.
    greeted: bool,
    /// Subscription packets not yet acknowledged since the last connect.
    unconfirmed: usize,
    /// How often it was connected.
    connects: usize,
    /// Subscribes again on this connection.
    again: Option<AbortHandle>,
    /// What was said last about each address.
    said: Vec<Option<String>>,
}

type Parts = (AsyncClient, Pump, mpsc::Receiver<LinkEvent>, oneshot::Sender<()>);

impl Pump {
    pub(crate) fn new(config: LinkConfig, shared: Arc<Shared>) -> Parts {
        let queue = config.queue.max(16);
        let mouth = Mouth::default();
        let (client, mut connection) =
            AsyncClient::builder(options(&config, 0, &mouth)).capacity(queue).build();
        let mut network = connection.network_options();
        network.set_tcp_nodelay(true);
        network.set_connection_timeout(5);
        connection.set_network_options(network);
        let (events, receiver) = mpsc::channel(queue);
        let (stopper, stop) = oneshot::channel();
        let pump = Self {
            said: vec![None; config.broker.places.len()],
            config,
            client: client.clone(),
            connection,
            mouth,
            events,
            stop,
            shared,
            backoff: Backoff::new(),
            at: 0,
            failures: 0,
            greeted: false,
            unconfirmed: 0,
            connects: 0,
            again: None,
        };
        (client, pump, receiver, stopper)
    }

    /// Runs until the link is closed or dropped.
    pub(crate) async fn run(mut self) {
        loop {
            let polled = tokio::select! {
                biased;
                _ = &mut self.stop => break,
                () = self.shared.renew.notified() => None,
                polled = self.connection.poll() => Some(polled),
            };
            let going_on = match polled {
                None => self.renew().await,
                Some(Ok(Event::Incoming(packet))) => self.incoming(packet).await,
                Some(Ok(Event::Outgoing(_))) => true,
                Some(Err(error)) => {
                    let line = reason(&error, self.place(), self.greeted);
                    self.failed(line).await
                }
            };
            if !going_on {
                break;
            }
        }
        self.goodbye().await;
    }

    fn place(&self) -> &Place {
        &self.config.broker.places[self.at]
    }

    async fn incoming(&mut self, packet: Packet) -> bool {
        match packet {
            Packet::ConnAck(answer) => {
                self.greeted = true;
                if !answer.session_present && !self.config.filters.is_empty() {
                    self.subscribe();
                    return true;
                }
                self.connected().await
            }
            Packet::SubAck(answer) if self.unconfirmed > 0 => self.confirmed(answer).await,
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

    /// Whoever uses the link has found its connection to be of no use.
    async fn renew(&mut self) -> bool {
        if !self.shared.connected.load(Ordering::Acquire) {
            return true;
        }
        self.connection.clean();
        let line = format!("{} passes on nothing that is said to it", self.place());
        self.failed(line).await
    }

    fn subscribe(&mut self) {
        self.unconfirmed = 0;
        for packet in packets(&self.config.filters) {
            match self.client.try_subscribe_many(packet) {
                Ok(()) => self.unconfirmed += 1,
                Err(error) => tracing::error!("cannot subscribe on {}: {error}", self.place()),
            }
        }
    }

    /// Says the subscriptions again in a while. Nobody waits for the answers: all was granted before.
    fn subscribe_later(&mut self) {
        let (client, filters) = (self.client.clone(), self.config.filters.clone());
        let later = async move {
            for wait in SUBSCRIBE_AGAIN {
                // Spread a little: a fleet comes back all at once.
                tokio::time::sleep(wait.mul_f64(1.0 + 0.2 * share())).await;
                // A full queue is another connection's business, or the next time's.
                let _ = packets(&filters).try_for_each(|packet| client.try_subscribe_many(packet));
            }
        };
        self.again = Some(tokio::spawn(later).abort_handle());
    }

    fn forget_again(&mut self) {
        if let Some(again) = self.again.take() {
            again.abort();
        }
    }

    /// Answers come in the order of the questions.
    async fn confirmed(&mut self, answer: SubAck) -> bool {
        let packets = self.config.filters.len().div_ceil(FILTERS_A_PACKET);
        let first = (packets - self.unconfirmed.min(packets)) * FILTERS_A_PACKET;
        let refused = answer.return_codes.iter().position(|code| *code == SubscribeReasonCode::Failure);
        if let Some(index) = refused {
            let filter = self.config.filters.get(first + index).map_or("a topic", String::as_str);
            let line = not_granted(filter, self.place());
            // Half a fleet's ears are none: better to say so, and to try again once the rights are mended.
            self.connection.clean();
            return self.failed(line).await;
        }
        self.unconfirmed -= 1;
        self.unconfirmed > 0 || self.connected().await
    }

    async fn connected(&mut self) -> bool {
        tracing::info!("connected to {}", self.place());
        self.backoff.reset();
        self.failures = 0;
        self.said.fill(None);
        self.connects += 1;
        self.forget_again();
        if self.connects > 1 {
            self.subscribe_later();
        }
        self.shared.at.store(self.at, Ordering::Release);
        self.shared.connected.store(true, Ordering::Release);
        self.events.send(LinkEvent::Connected).await.is_ok()
    }

    /// The connection failed: says so where that is news, then waits for the next attempt, at the next address.
    async fn failed(&mut self, reason: String) -> bool {
        let was_connected = self.shared.connected.swap(false, Ordering::AcqRel);
        self.greeted = false;
        self.forget_again();
        self.failures += 1;
        // What was to be sent on the old connection is stale on the next.
        self.connection.reset_session_state();
        if was_connected || self.said[self.at].as_deref() != Some(&reason) {
            tracing::warn!("{reason}");
            self.said[self.at] = Some(reason.clone());
            if self.events.send(LinkEvent::Disconnected { reason }).await.is_err() {
                return false;
            }
        }
        let places = self.config.broker.places.len();
        let wait = if self.failures.is_multiple_of(places) {
            self.backoff.wait(random())
        } else {
            NEXT_PLACE.mul_f64(share())
        };
        self.at = (self.at + 1) % places;
        self.connection.mqtt_options = options(&self.config, self.at, &self.mouth);
        tokio::select! {
            _ = &mut self.stop => false,
            () = self.events.closed() => false,
            () = tokio::time::sleep(wait) => true,
        }
    }

    /// Flushes what was sent and leaves, within [`GOODBYE`].
    async fn goodbye(mut self) {
        self.forget_again();
        if !self.shared.connected.swap(false, Ordering::AcqRel) || self.client.try_disconnect().is_err() {
            return;
        }
        let flush = async {
            while self.connection.poll().await.is_ok() {}
            drop(self.connection);
            self.mouth.finish().await;
        };
        // A broker that does not take it in time loses the connection without a goodbye.
        let _ = tokio::time::timeout(GOODBYE, flush).await;
    }
}

/// Filters in packets that every broker takes.
fn packets(filters: &[String]) -> impl Iterator<Item = Vec<SubscribeFilter>> {
    let filter = |filter: &String| SubscribeFilter::new(filter.clone(), QoS::AtMostOnce);
    filters.chunks(FILTERS_A_PACKET).map(move |packet| packet.iter().map(filter).collect())
}

/// At random, 0 to 1.
fn share() -> f64 {
    f64::from(random()) / f64::from(u32::MAX)
}

fn random() -> u32 {
    let mut bytes = [0; 4];
    // Without randomness the wait is merely not spread.
    let _ = getrandom::fill(&mut bytes);
    u32::from_le_bytes(bytes)
}

fn options(config: &LinkConfig, at: usize, mouth: &Mouth) -> MqttOptions {
    let broker = &config.broker;
    let place = &broker.places[at];
    let mut options = MqttOptions::new(config.client_id.clone(), (place.host.clone(), place.port));
    options.set_keep_alive(15).set_max_packet_size(LONGEST_PACKET, LONGEST_PACKET).set_inflight(1000);
    let mouth = mouth.clone();
    options.set_socket_connector(move |address, network| {
        let mouth = mouth.clone();
        async move { Ok(mouth.speaks_on(rumqttc::default_socket_connect(address, network).await?)) }
    });
    if let Some(user) = &broker.user {
        options.set_credentials(user.clone(), broker.password.clone().unwrap_or_default());
    }
    if place.tls {
        match broker.trust.clone().map_or_else(Trust::of_system, Ok) {
            Ok(trust) => {
                options.set_transport(Transport::tls_with_config(TlsConfiguration::Rustls(trust.config())));
            }
            // Nobody is believed then, and every attempt says so.
            Err(error) => {
                tracing::error!("{error}");
                options.set_transport(Transport::tls_with_config(TlsConfiguration::Simple {
                    ca: Vec::new(),
                    alpn: None,
                    client_auth: None,
                }));
            }
        }
    }
    options
}
