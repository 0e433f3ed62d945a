//! Bounds the number of connections to the web app, because files, broker and robots of this program need sockets, too.
//! When the bound is reached, the connection that was silent for the longest time makes room, if it was silent for long
//! enough.

use std::collections::BTreeMap;
use std::io;
use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::sync::oneshot;

/// Least time without a byte in either direction after which a connection may be closed to make room. A client waits 20 s
/// for its turn to upload without sending.
const SILENT: Duration = Duration::from_secs(40);

/// The open connections, at most `most`.
#[derive(Debug)]
pub struct Guests {
    most: usize,
    /// Time without a byte in either direction after which a connection may be closed.
    silent: Duration,
    next: u64,
    lines: Arc<Mutex<BTreeMap<u64, Line>>>,
}

#[derive(Debug)]
struct Line {
    /// Time of the last byte in either direction.
    alive: Arc<Mutex<Instant>>,
    /// Dropped to end the connection.
    _end: oneshot::Sender<()>,
}

/// The place of one connection among [`Guests`]. Dropping this value frees the place.
#[derive(Debug)]
pub struct GuestPlace {
    number: u64,
    alive: Arc<Mutex<Instant>>,
    ended: oneshot::Receiver<()>,
    lines: Arc<Mutex<BTreeMap<u64, Line>>>,
}

impl Guests {
    /// Room for `most` connections. `longest_wait`: longest time that a client waits for an answer without sending.
    pub fn new(most: usize, longest_wait: Duration) -> Self {
        Self { most, silent: SILENT.max(longest_wait), next: 0, lines: Arc::default() }
    }

    /// The most connections that may be open.
    pub fn most(&self) -> usize {
        self.most
    }

    /// Returns a place for a further connection. If all places are taken, closes the connection that has been silent
    /// for longest. If even that one was silent for less than `silent`, returns `None`.
    pub fn admit(&mut self, now: Instant) -> Option<GuestPlace> {
        if lock(&self.lines).len() >= self.most && !self.close_silent(now) {
            return None;
        }
        let number = self.next;
        self.next += 1;
        let (end, ended) = oneshot::channel();
        let alive = Arc::new(Mutex::new(now));
        lock(&self.lines).insert(number, Line { alive: alive.clone(), _end: end });
        Some(GuestPlace { number, alive, ended, lines: self.lines.clone() })
    }

    /// Ends the connection that has been silent for longest, if that is at least `silent`. Returns whether a connection was
    /// ended.
    pub fn close_silent(&self, now: Instant) -> bool {
        let mut lines = lock(&self.lines);
        let oldest = lines.iter().map(|(number, line)| (*lock(&line.alive), *number)).min();
        let silent = oldest.filter(|(alive, _)| now.duration_since(*alive) >= self.silent);
        silent.is_some_and(|(_, number)| lines.remove(&number).is_some())
    }
}

impl Drop for GuestPlace {
    fn drop(&mut self) {
        lock(&self.lines).remove(&self.number);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A connection that holds its place among [`Guests`].
#[derive(Debug)]
pub struct Guest {
    stream: TcpStream,
    place: GuestPlace,
}

impl Guest {
    /// Puts a connection into its place.
    pub fn new(stream: TcpStream, place: GuestPlace) -> Self {
        Self { stream, place }
    }

    /// Waits for the first byte that the client sends and returns it. Later reads still get that byte.
    pub async fn first_byte(&self) -> io::Result<u8> {
        let mut first = [0];
        match self.stream.peek(&mut first).await? {
            0 => Err(io::ErrorKind::UnexpectedEof.into()),
            _ => Ok(first[0]),
        }
    }

    fn note<T>(&self, done: &Poll<io::Result<T>>) {
        if let Poll::Ready(Ok(_)) = done {
            *lock(&self.place.alive) = Instant::now();
        }
    }
}

impl AsyncRead for Guest {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if Pin::new(&mut self.place.ended).poll(context).is_ready() {
            return Poll::Ready(Err(io::ErrorKind::ConnectionAborted.into()));
        }
        let done = Pin::new(&mut self.stream).poll_read(context, bytes);
        self.note(&done);
        done
    }
}

impl AsyncWrite for Guest {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let done = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.note(&done);
        done
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let done = Pin::new(&mut self.stream).poll_write_vectored(context, bytes);
        self.note(&done);
        done
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_house_takes_another_guest_for_the_one_that_was_silent_for_the_longest_time() {
        let began = Instant::now();
        let mut guests = Guests::new(2, Duration::from_secs(5));
        let mut first = guests.admit(began).unwrap();
        let mut second = guests.admit(began).unwrap();
        *lock(&first.alive) = began + Duration::from_secs(1);
        assert!(
            guests.admit(began + SILENT - Duration::from_millis(1)).is_none(),
            "no client is silent for long"
        );
        let _third = guests.admit(began + SILENT).unwrap();
        assert!(second.ended.try_recv() == Err(oneshot::error::TryRecvError::Closed), "its connection ends");
        assert!(first.ended.try_recv() == Err(oneshot::error::TryRecvError::Empty));
        assert!(guests.admit(began + SILENT).is_none());
        drop(first);
        assert!(guests.admit(began + SILENT).is_some());
    }

    #[test]
    fn a_client_that_waits_for_a_long_plan_keeps_its_connection() {
        let (began, longest_wait) = (Instant::now(), SILENT * 10);
        let mut guests = Guests::new(1, longest_wait);
        let _waiting = guests.admit(began).unwrap();
        assert!(guests.admit(began + longest_wait - Duration::from_millis(1)).is_none());
        assert!(guests.admit(began + longest_wait).is_some());
    }
}
