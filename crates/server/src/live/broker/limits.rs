//! Limits on what the embedded broker takes from clients. Beyond a limit, the client loses a message, a subscription or
//! its connection; the broker and its other clients go on.
// Connections without a login are found only on Linux.
#![cfg_attr(not(target_os = "linux"), allow(dead_code))]

use std::time::Duration;

/// The rate at which a client may publish messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    /// Messages per second in the long run.
    pub per_second: u32,
    /// Messages that a client may send at once, in addition to the long-run rate.
    pub burst: u32,
}

/// Longest packet, in bytes: four times the longest message of the protocol (docs/brokers.md, "What matters in any
/// broker"). A longer packet costs its sender the connection. Each connection may make the broker hold one incomplete
/// packet, so that this and [`CONNECTIONS`] together bound memory.
pub const PACKET_BYTES: u32 = 64 << 10;

/// Most levels of a topic or filter. The protocol's topics have at most four. The broker walks its tree of topics by
/// recursion: some thousands of levels overflow the stack.
pub const TOPIC_LEVELS: usize = 16;

/// Longest topic or filter, in bytes. The protocol's longest has 47.
pub const TOPIC_BYTES: usize = 512;

/// Longest client id, in bytes. Those of our robots and controllers have at most 50.
pub const CLIENT_ID_BYTES: usize = 256;

/// Most subscriptions of one client. A connection that simulated robots share has one for each robot, at most 1,000, and one
/// for the messages to all robots.
pub const SUBSCRIPTIONS: usize = 2_048;

/// Most subscriptions of all clients together: ten thousand robots and their controller have 20,004.
pub const SUBSCRIPTIONS_TOTAL: usize = 50_000;

/// Most clients that are logged in: ten thousand robots, their controllers and tools.
pub const CONNECTIONS: usize = 12_000;

/// Open files of the broker beside the connections of logged-in clients: connections that have not logged in, and its
/// own files.
const OTHER_FILES: usize = PENDING + 100;

/// Sockets for a client behind the TLS gate: the client's, and both ends of the gate's connection to the broker.
const TLS_SOCKETS: usize = 3;

/// Returns how many clients may be logged in if the system grants `open_files` open files: at most [`CONNECTIONS`]. At
/// least half of the files are left to clients. With `has_tls`, each client is counted with `TLS_SOCKETS` files.
pub fn connections(open_files: usize, has_tls: bool) -> usize {
    let sockets = if has_tls { TLS_SOCKETS } else { 1 };
    let files = open_files.saturating_sub(OTHER_FILES).max(open_files / 2);
    CONNECTIONS.min(files / sockets)
}

/// Longest report of a robot, in bytes. The longest that our robots send has 400 (R10 with every field).
pub const REPORT_BYTES: usize = 4_096;

/// Rate limit of one robot, and of a client with the role cue. A robot reports at most ten times a second, and acknowledges
/// each part of its routes. A robot that comes back to a long show acknowledges 100 parts at once.
pub const ROBOT_RATE: Rate = Rate { per_second: 100, burst: 1_000 };

/// Rate limit of a tool, and of a connection that robots share. At most 1,000 robots share one, and each answers a frame
/// with some twenty messages.
pub const SHARED_RATE: Rate = Rate { per_second: 30_000, burst: 60_000 };

/// How long a client that was cut off for a flood may not connect.
pub const FLOOD_BAN: Duration = Duration::from_secs(30);

/// Most sessions, including those of clients that are away for a while.
pub const SESSIONS: isize = 16_000;

/// Longest time for which the session of a client that is away is kept.
pub const SESSION_EXPIRY: Duration = Duration::from_secs(15 * 60);

/// Most connections without a complete CONNECT packet. If there are more, the oldest surplus ones are closed as soon as they
/// are older than [`PENDING_GRACE`].
pub const PENDING: usize = 500;

/// How long the oldest connections may stay without a CONNECT packet while there are more than [`PENDING`] of them.
pub const PENDING_GRACE: Duration = Duration::from_secs(1);

/// How long a connection may stay without a complete CONNECT packet. A robot on a poor radio link needs two seconds.
pub const CONNECT_WITHIN: Duration = Duration::from_secs(10);

/// A client that takes no byte for this time, while messages for it wait, loses its connection.
pub const SEND_WITHIN: Duration = Duration::from_secs(10);

/// Most bytes that wait for one client, [`MESSAGE_OVERHEAD_BYTES`] of each message included. When ten thousand robots
/// answer a frame at once, 20,000 messages of 150 bytes wait for the controller: 29 MB. Further messages to the client
/// are dropped.
pub const QUEUE_BYTES: usize = 48 << 20;

/// Most bytes that wait for all clients together. Further messages are dropped for clients whose own queue is above
/// [`QUEUE_SHARE_BYTES`].
pub const QUEUE_BYTES_TOTAL: usize = 128 << 20;

/// Bytes that may wait for each client, even if the queues of all clients together are full. Slow readers thus cannot block
/// the commands for a robot.
pub const QUEUE_SHARE_BYTES: usize = 32 << 10;

/// Bytes that a waiting message takes in the broker beside payload and topic. Measured 2026-11-23 on x86-64 with 21,760
/// empty messages that waited for a subscriber that did not read: 1,280 bytes each.
pub const MESSAGE_OVERHEAD_BYTES: usize = 1_280;

/// Most retained messages. The protocol uses none; tools may use some.
pub const RETAINED: usize = 256;

/// Most bytes of all retained messages. rmqtt copies those that match a subscription.
pub const RETAINED_BYTES: usize = 1 << 20;

/// Most subscriptions that wait for their retained messages: those of four clients with all [`SUBSCRIPTIONS`]. Further
/// subscriptions get none.
pub const RETAINED_WAITING: usize = 4 * SUBSCRIPTIONS;

/// Most topic aliases of a client of MQTT 5, in each direction. Each costs the broker up to [`TOPIC_BYTES`]; the
/// protocol has six topics per robot.
pub const TOPIC_ALIASES: u16 = 8;

/// Longest keep-alive of a client of MQTT 5, in seconds. A longer one is shortened (section 3.2.2.3.14), so that a
/// connection that died without a word is noticed after 90 s. Clients of MQTT 3 choose theirs: the standard gives the
/// broker no way to shorten it.
pub const KEEP_ALIVE_S: u16 = 60;

/// Most bytes of data of the broker's process, on Linux only. Above it, the process ends. The command `run` then starts it
/// again. The limits above keep the process far below it.
pub const PROCESS_BYTES: u64 = 1 << 30;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connections_fit_the_open_files_that_the_system_grants() {
        assert_eq!(
            [65_536, 20_000, 4_096, 1_024, 256].map(|files| connections(files, false)),
            [12_000, 12_000, 3_496, 512, 128]
        );
        assert_eq!([65_536, 4_096].map(|files| connections(files, true)), [12_000, 1_165]);
    }
}
