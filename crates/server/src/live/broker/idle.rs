//! Closes connections that do not log in. rmqtt waits for ever for the first byte of a connection, and gives no access
//! to its sockets. They are therefore found among the open files of this process.

#[cfg(target_os = "linux")]
use std::net::SocketAddr;
use std::sync::Arc;

use super::admitted::Admitted;
use super::notices::Notices;

/// Closes connections to these ports whose clients do not log in soon enough, until the task is dropped.
#[cfg(target_os = "linux")]
pub async fn close_idle(ports: Vec<u16>, admitted: Arc<Admitted>, notices: Arc<Notices>) {
    let mut watch = linux::Watch::new(ports, admitted);
    loop {
        tokio::time::sleep(linux::EVERY).await;
        for peer in watch.look(std::time::Instant::now()) {
            say(&notices, peer);
        }
    }
}

/// Does nothing. Connections that do not log in are found only on Linux. On other systems, they stay open.
#[cfg(not(target_os = "linux"))]
pub async fn close_idle(_: Vec<u16>, _: Arc<Admitted>, _: Arc<Notices>) {}

#[cfg(target_os = "linux")]
fn say(notices: &Notices, peer: SocketAddr) {
    let line = format!("The broker closed a connection from {}: it did not log in.", peer.ip());
    notices.say(&peer.ip().to_string(), &line);
}

#[cfg(target_os = "linux")]
mod linux {
    use std::collections::BTreeMap;
    use std::net::SocketAddr;
    use std::os::fd::OwnedFd;
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    use rustix::net::{Shutdown, getpeername, getsockname, shutdown};
    use rustix::process::{PidfdFlags, PidfdGetfdFlags, getpid, pidfd_getfd, pidfd_open};

    use super::super::limits;
    use super::Admitted;

    /// Time between two checks of all sockets. A check of ten thousand sockets takes about 10 ms.
    pub const EVERY: Duration = Duration::from_secs(1);

    /// Inode number of a socket. The system may use a file descriptor again at once, but not an inode number.
    type Inode = u64;

    /// Watches the sockets of this process for connections that do not log in.
    pub struct Watch {
        ports: Vec<u16>,
        admitted: Arc<Admitted>,
        seen: BTreeMap<Inode, Socket>,
    }

    enum Socket {
        /// The socket belongs to no client.
        Other,
        /// The client has logged in.
        Admitted { peer: SocketAddr },
        /// The client has not logged in; `since`: when the socket was first seen.
        Pending { peer: SocketAddr, since: Instant },
    }

    impl Watch {
        pub fn new(ports: Vec<u16>, admitted: Arc<Admitted>) -> Self {
            Self { ports, admitted, seen: BTreeMap::new() }
        }

        /// Closes connections whose clients have not logged in soon enough. Returns the addresses of these clients.
        pub fn look(&mut self, now: Instant) -> Vec<SocketAddr> {
            let open = open_sockets();
            self.forget_closed(&open);
            for (inode, file) in &open {
                if !self.seen.contains_key(inode) {
                    let socket = self.classify(*file, now);
                    self.seen.insert(*inode, socket);
                }
            }
            for socket in self.seen.values_mut() {
                if let Socket::Pending { peer, .. } = *socket
                    && self.admitted.contains(peer)
                {
                    *socket = Socket::Admitted { peer };
                }
            }
            let late = self.late(now).into_iter();
            let closed = late.filter(|(inode, peer)| open.get(inode).is_some_and(|file| close(*file, *peer)));
            closed.map(|(_, peer)| peer).collect()
        }

        fn forget_closed(&mut self, open: &BTreeMap<Inode, i32>) {
            self.seen.retain(|inode, socket| {
                let is_open = open.contains_key(inode);
                if let (false, Socket::Admitted { peer }) = (is_open, socket) {
                    self.admitted.remove(*peer);
                }
                is_open
            });
        }

        fn classify(&self, file: i32, now: Instant) -> Socket {
            let client = own(file).and_then(|socket| {
                let local = SocketAddr::try_from(getsockname(&socket).ok()?).ok()?;
                let peer = SocketAddr::try_from(getpeername(&socket).ok()??).ok()?;
                self.ports.contains(&local.port()).then_some(peer)
            });
            client.map_or(Socket::Other, |peer| Socket::Pending { peer, since: now })
        }

        /// Returns the connections whose time to log in is over, the oldest first.
        fn late(&self, now: Instant) -> Vec<(Inode, SocketAddr)> {
            let mut pending: Vec<_> = self
                .seen
                .iter()
                .filter_map(|(inode, socket)| match socket {
                    Socket::Pending { peer, since } => Some((*since, *inode, *peer)),
                    Socket::Other | Socket::Admitted { .. } => None,
                })
                .collect();
            pending.sort_unstable();
            let surplus = pending.len().saturating_sub(limits::PENDING);
            let is_late = |(index, (since, _, _)): &(usize, (Instant, Inode, SocketAddr))| {
                let patience = if *index < surplus { limits::PENDING_GRACE } else { limits::CONNECT_WITHIN };
                now.duration_since(*since) >= patience
            };
            let late = pending.into_iter().enumerate().filter(is_late);
            late.map(|(_, (_, inode, peer))| (inode, peer)).collect()
        }
    }

    /// Returns the sockets among the open files of this process, with their file descriptors.
    fn open_sockets() -> BTreeMap<Inode, i32> {
        let Ok(files) = std::fs::read_dir("/proc/self/fd") else { return BTreeMap::new() };
        let socket = |file: std::fs::DirEntry| {
            let target = std::fs::read_link(file.path()).ok()?;
            let inode = target.to_str()?.strip_prefix("socket:[")?.strip_suffix(']')?.parse().ok()?;
            Some((inode, file.file_name().to_str()?.parse().ok()?))
        };
        files.flatten().filter_map(socket).collect()
    }

    /// Duplicates the file descriptor of a socket that belongs to other code. Meanwhile the number may belong to another
    /// file, which callers check.
    fn own(file: i32) -> Option<OwnedFd> {
        let process = pidfd_open(getpid(), PidfdFlags::empty()).ok()?;
        pidfd_getfd(&process, file, PidfdGetfdFlags::empty()).ok()
    }

    /// Ends a connection if its client still is `peer`. The code that owns the socket then sees that the client has gone.
    /// Returns whether the connection was ended.
    fn close(file: i32, peer: SocketAddr) -> bool {
        let Some(socket) = own(file) else { return false };
        let is_same =
            getpeername(&socket).ok().flatten().and_then(|address| SocketAddr::try_from(address).ok())
                == Some(peer);
        is_same && shutdown(&socket, Shutdown::Both).is_ok()
    }
}
