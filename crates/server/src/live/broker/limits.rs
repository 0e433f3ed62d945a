//! What the embedded broker takes from a client at most. Beyond a limit the client loses a message or its connection;
//! the broker and its other clients go on.
// Only on Linux connections without a login are found.
#![cfg_attr(not(target_os = "linux"), allow(dead_code))]

use std::time::Duration;

/// Longest packet, in bytes: four times the longest message of the protocol (docs/brokers.md, "What matters in any
/// broker"). A longer packet costs its sender the connection. Each connection may make the broker hold one packet that
/// is not complete, so that this bounds memory together with [`CONNECTIONS`].
pub const PACKET_BYTES: u32 = 64 << 10;

/// Levels of a topic or filter. The protocol's topics have three. The broker's tree of topics is walked by recursion:
/// some thousands of levels overflow the stack.
pub const TOPIC_LEVELS: usize = 16;

/// Length of a topic or filter, in bytes. The protocol's longest has 47.
pub const TOPIC_BYTES: usize = 512;

/// Length of a client id, in bytes. Ours have at most 50.
pub const CLIENT_ID_BYTES: usize = 256;

/// Subscriptions of one client. A connection that simulated robots share has one per robot, at most 1,000, and one more.
pub const SUBSCRIPTIONS: usize = 2_048;

/// Subscriptions of all clients together: ten thousand robots and their controller have 20,004.
pub const SUBSCRIPTIONS_TOTAL: usize = 50_000;

/// Clients that are logged in: ten thousand robots, their controllers and tools.
pub const CONNECTIONS: usize = 12_000;

/// Sessions, those of clients that are away for a while included.
pub const SESSIONS: isize = 16_000;

/// How long the session of a client that is away is kept, at most.
pub const SESSION_EXPIRY: Duration = Duration::from_secs(15 * 60);

/// Connections that have not sent a CONNECT packet yet. Beyond it those older than [`PENDING_GRACE`] are closed early.
pub const PENDING: usize = 500;

/// How long a connection may stay without a CONNECT packet while there are more than [`PENDING`] of them.
pub const PENDING_GRACE: Duration = Duration::from_secs(1);

/// How long a connection may stay without a complete CONNECT packet. A robot on a poor radio link needs two seconds.
pub const CONNECT_WITHIN: Duration = Duration::from_secs(10);

/// A client that takes nothing for this long while messages wait loses its connection.
pub const SEND_WITHIN: Duration = Duration::from_secs(10);

/// Bytes that wait for one client, [`MESSAGE_OVERHEAD_BYTES`] of each message included. When ten thousand robots answer a
/// frame at once, 20,000 messages of 150 bytes wait for the controller: 29 MB. Further messages to the client are dropped.
pub const QUEUE_BYTES: usize = 48 << 20;

/// Bytes that wait for all clients together. Further messages are dropped for clients whose own queue is above
/// [`QUEUE_SHARE_BYTES`].
pub const QUEUE_BYTES_TOTAL: usize = 128 << 20;

/// Bytes that may wait for a client whatever waits for the others: slow readers cannot take a robot's commands from it.
pub const QUEUE_SHARE_BYTES: usize = 32 << 10;

/// Bytes that a waiting message takes in the broker beside payload and topic. Measured 2026-11-23 on x86-64 with 21,760
/// empty messages that waited for a subscriber that did not read: 1,280 bytes each.
pub const MESSAGE_OVERHEAD_BYTES: usize = 1_280;

/// Bytes of data that the broker's process may have, where the system can bound it. Above it the process ends and is
/// started again; the limits above keep it far below.
pub const PROCESS_BYTES: u64 = 1 << 30;
