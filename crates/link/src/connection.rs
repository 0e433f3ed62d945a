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
use crate::detached_writer::DetachedWriter;
use crate::interface::{LinkConfig, LinkEvent, LinkStatus};
use crate::reason::{not_granted, reason};
use crate::{BrokerAddress, TlsTrust};

/// Longest MQTT packet, bytes: a thousand times the longest payload (R4). A longer packet closes the connection.
const PACKET_BYTES_MAX: usize = 16 << 20;
/// Largest number of topic filters in one subscription packet. With at most 512 bytes per filter (docs/brokers.md), the
/// packet stays below 65,536 bytes. With a larger value, a broker may refuse the packet.
const FILTERS_PER_PACKET: usize = 100;
/// Longest time for sending queued messages before a disconnect, chosen by us. With a longer time, programs would end
/// late.
const DISCONNECT_MAX: Duration = Duration::from_millis(500);
/// After a reconnect, all subscriptions are repeated three times. These are the waiting times before each repetition,
/// each lengthened at random by up to a fifth. The repetitions are needed because a cluster that has lost a node may
/// later delete new subscriptions of that node's clients (RabbitMQ 3.10, docs/brokers.md).
const RESUBSCRIBE_AFTER: [Duration; 3] =
    [Duration::from_millis(1_000), Duration::from_millis(2_000), Duration::from_millis(6_000)];
/// Longest random wait before the next address is tried. It keeps the robots of a fleet from connecting at one moment.
/// With a longer wait, robots could reach the 1.9 s without messages after which they stop (R43 of docs/protocol.md).
const NEXT_ADDRESS_MAX: Duration = Duration::from_millis(100);

pub(crate) struct ConnectionTask {
    config: LinkConfig,
    client: AsyncClient,
    connection: EventLoop,
    writer: DetachedWriter,
    events: mpsc::Sender<LinkEvent>,
    stop: oneshot::Receiver<()>,
    status: Arc<LinkStatus>,
    backoff: Backoff,
    /// Index of the address that is in use or is tried.
    at: usize,
    /// Number of failures since the link was last connected and subscribed.
    failures: usize,
    /// Whether the broker has accepted the login on the present connection.
    accepted: bool,
    /// Number of subscription packets that the broker has not yet acknowledged since the last connect.
    unconfirmed: usize,
    /// How often the link has been connected and subscribed.
    connects: usize,
    /// Task that repeats the subscriptions on the present connection; `None`: there is no such task.
    resubscription: Option<AbortHandle>,
    /// `[address]`: the last reported reason for a failure since the link was last connected; `None`: no failure was
    /// reported.
    reported: Vec<Option<String>>,
}

type Parts = (AsyncClient, ConnectionTask, mpsc::Receiver<LinkEvent>, oneshot::Sender<()>);

impl ConnectionTask {
    pub(crate) fn new(config: LinkConfig, status: Arc<LinkStatus>) -> Parts {
        let queue = config.queue.max(16);
        let writer = DetachedWriter::default();
        let (client, mut connection) =
            AsyncClient::builder(options(&config, 0, &writer)).capacity(queue).build();
        let mut network = connection.network_options();
        network.set_tcp_nodelay(true);
        network.set_connection_timeout(5);
        connection.set_network_options(network);
        let (events, receiver) = mpsc::channel(queue);
        let (stopper, stop) = oneshot::channel();
        let connection = Self {
            reported: vec![None; config.broker.addresses.len()],
            config,
            client: client.clone(),
            connection,
            writer,
            events,
            stop,
            status,
            backoff: Backoff::new(),
            at: 0,
            failures: 0,
            accepted: false,
            unconfirmed: 0,
            connects: 0,
            resubscription: None,
        };
        (client, connection, receiver, stopper)
    }

    /// Runs until the link is closed or dropped.
    pub(crate) async fn run(mut self) {
        loop {
            let polled = tokio::select! {
                biased;
                _ = &mut self.stop => break,
                () = self.status.renew.notified() => None,
                polled = self.connection.poll() => Some(polled),
            };
            let going_on = match polled {
                None => self.renew().await,
                Some(Ok(Event::Incoming(packet))) => self.incoming(packet).await,
                Some(Ok(Event::Outgoing(_))) => true,
                Some(Err(error)) => {
                    let line = reason(&error, self.address(), self.accepted);
                    self.failed(line).await
                }
            };
            if !going_on {
                break;
            }
        }
        self.disconnect().await;
    }

    fn address(&self) -> &BrokerAddress {
        &self.config.broker.addresses[self.at]
    }

    async fn incoming(&mut self, packet: Packet) -> bool {
        match packet {
            Packet::ConnAck(answer) => {
                self.accepted = true;
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
                let retained = message.retain;
                if self.events.try_send(LinkEvent::Message { topic, payload, retained }).is_err() {
                    self.status.dropped.fetch_add(1, Ordering::Relaxed);
                }
                !self.events.is_closed()
            }
            _ => true,
        }
    }

    /// Closes the connection, because it does not deliver messages, and waits until the next attempt is due. Returns
    /// `false` if the link was closed meanwhile. If the link is not connected, does nothing and returns `true`.
    async fn renew(&mut self) -> bool {
        if !self.status.connected.load(Ordering::Acquire) {
            return true;
        }
        self.connection.clean();
        let line = format!("{} passes on nothing that is said to it", self.address());
        self.failed(line).await
    }

    fn subscribe(&mut self) {
        self.unconfirmed = 0;
        for packet in packets(&self.config.filters) {
            match self.client.try_subscribe_many(packet) {
                Ok(()) => self.unconfirmed += 1,
                Err(error) => tracing::error!("cannot subscribe on {}: {error}", self.address()),
            }
        }
    }

    /// Starts a task that repeats the subscriptions after the times of [`RESUBSCRIBE_AFTER`]. The broker's answers to
    /// them are ignored, because it granted all filters when the link connected.
    fn subscribe_later(&mut self) {
        let (client, filters) = (self.client.clone(), self.config.filters.clone());
        let later = async move {
            for wait in RESUBSCRIBE_AFTER {
                // Spread in time, because all robots of a fleet reconnect together.
                tokio::time::sleep(wait.mul_f64(1.0 + 0.2 * share())).await;
                // A full queue is ignored: the next repetition follows.
                let _ = packets(&filters).try_for_each(|packet| client.try_subscribe_many(packet));
            }
        };
        self.resubscription = Some(tokio::spawn(later).abort_handle());
    }

    fn cancel_resubscription(&mut self) {
        if let Some(resubscription) = self.resubscription.take() {
            resubscription.abort();
        }
    }

    /// Handles the broker's answer to a subscription packet. Answers come in the order of the packets. A refused filter
    /// counts as a failed connection. Returns `false` if the link was closed meanwhile.
    async fn confirmed(&mut self, answer: SubAck) -> bool {
        let packets = self.config.filters.len().div_ceil(FILTERS_PER_PACKET);
        let first = (packets - self.unconfirmed.min(packets)) * FILTERS_PER_PACKET;
        let refused = answer.return_codes.iter().position(|code| *code == SubscribeReasonCode::Failure);
        if let Some(index) = refused {
            let filter = self.config.filters.get(first + index).map_or("a topic", String::as_str);
            let line = not_granted(filter, self.address());
            // Partial subscriptions are useless: report the refusal and try again.
            self.connection.clean();
            return self.failed(line).await;
        }
        self.unconfirmed -= 1;
        self.unconfirmed > 0 || self.connected().await
    }

    async fn connected(&mut self) -> bool {
        tracing::info!("connected to {}", self.address());
        self.backoff.reset();
        self.failures = 0;
        self.reported.fill(None);
        self.connects += 1;
        self.cancel_resubscription();
        if self.connects > 1 {
            self.subscribe_later();
        }
        self.status.at.store(self.at, Ordering::Release);
        self.status.connected.store(true, Ordering::Release);
        self.events.send(LinkEvent::Connected).await.is_ok()
    }

    /// Handles a failure of the present address: drops queued messages, chooses the next address, and waits until the
    /// next attempt is due. Reports the failure if its reason is new for this address or the link was connected.
    /// Returns `false` if the link was closed meanwhile.
    async fn failed(&mut self, reason: String) -> bool {
        let was_connected = self.status.connected.swap(false, Ordering::AcqRel);
        self.accepted = false;
        self.cancel_resubscription();
        self.failures += 1;
        // Messages queued for the old connection are too old for the next one.
        self.connection.reset_session_state();
        if was_connected || self.reported[self.at].as_deref() != Some(&reason) {
            tracing::warn!("{reason}");
            self.reported[self.at] = Some(reason.clone());
            if self.events.send(LinkEvent::Disconnected { reason }).await.is_err() {
                return false;
            }
        }
        let addresses = self.config.broker.addresses.len();
        let wait = if self.failures.is_multiple_of(addresses) {
            self.backoff.wait(random())
        } else {
            NEXT_ADDRESS_MAX.mul_f64(share())
        };
        self.at = (self.at + 1) % addresses;
        self.connection.mqtt_options = options(&self.config, self.at, &self.writer);
        tokio::select! {
            _ = &mut self.stop => false,
            () = self.events.closed() => false,
            () = tokio::time::sleep(wait) => true,
        }
    }

    /// Sends the queued messages and disconnects, if the link is connected. Gives up after [`DISCONNECT_MAX`].
    async fn disconnect(mut self) {
        self.cancel_resubscription();
        if !self.status.connected.swap(false, Ordering::AcqRel) || self.client.try_disconnect().is_err() {
            return;
        }
        let flush = async {
            while self.connection.poll().await.is_ok() {}
            drop(self.connection);
            self.writer.finish().await;
        };
        // If the broker does not read in time, the connection closes without a DISCONNECT.
        let _ = tokio::time::timeout(DISCONNECT_MAX, flush).await;
    }
}

/// The topic filters, split into packets of at most `FILTERS_PER_PACKET`, to subscribe to at QoS 0.
fn packets(filters: &[String]) -> impl Iterator<Item = Vec<SubscribeFilter>> {
    let filter = |filter: &String| SubscribeFilter::new(filter.clone(), QoS::AtMostOnce);
    filters.chunks(FILTERS_PER_PACKET).map(move |packet| packet.iter().map(filter).collect())
}

/// A random number from 0 to 1, both included.
fn share() -> f64 {
    f64::from(random()) / f64::from(u32::MAX)
}

fn random() -> u32 {
    let mut bytes = [0; 4];
    // Without random numbers the wait is not spread, which is harmless.
    let _ = getrandom::fill(&mut bytes);
    u32::from_le_bytes(bytes)
}

fn options(config: &LinkConfig, at: usize, writer: &DetachedWriter) -> MqttOptions {
    let broker = &config.broker;
    let address = &broker.addresses[at];
    let mut options = MqttOptions::new(config.client_id.clone(), (address.host.clone(), address.port));
    options.set_keep_alive(15).set_max_packet_size(PACKET_BYTES_MAX, PACKET_BYTES_MAX).set_inflight(1000);
    let writer = writer.clone();
    options.set_socket_connector(move |address, network| {
        let writer = writer.clone();
        async move { Ok(writer.attach(rumqttc::default_socket_connect(address, network).await?)) }
    });
    if let Some(user) = &broker.user {
        options.set_credentials(user.clone(), broker.password.clone().unwrap_or_default());
    }
    if address.tls {
        match broker.trust.clone().map_or_else(TlsTrust::of_system, Ok) {
            Ok(trust) => {
                options.set_transport(Transport::tls_with_config(TlsConfiguration::Rustls(trust.config())));
            }
            // Without authorities every attempt fails and reports why.
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
