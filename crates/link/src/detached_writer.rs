//! A TCP connection that keeps reading while its writes are blocked.
//!
//! The MQTT client reads nothing until all its output is written, and a broker may do the same. If thousands of robots
//! answer while thousands of commands are sent, both sides would wait for each other. Here output goes to a buffer at
//! once, and a task of its own writes it.

use std::sync::{Arc, Mutex, PoisonError};

use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt, BufReader};
use tokio::net::TcpStream;
use tokio::task::JoinHandle;

/// Largest number of bytes of output that may wait: 1,600 for each of ten thousand robots. If more waits, the MQTT
/// client blocks until some of it is written. With a larger value, commands to a slow broker arrive later.
const WAITING_BYTES_MAX: usize = 16 << 20;
/// Largest number of bytes that are written at once. Fewer need more system calls. A usual size of socket buffers, not
/// measured.
const WRITE_BYTES_MAX: usize = 64 << 10;

/// The task that writes the output of the present connection. It ends when the connection was dropped and all output is
/// written, or when the connection fails.
#[derive(Clone, Debug, Default)]
pub(crate) struct DetachedWriter(Arc<Mutex<Option<JoinHandle<()>>>>);

impl DetachedWriter {
    /// Wraps a socket. What is written to the result waits in a buffer, and a new task of this writer writes the buffer
    /// to the socket.
    pub(crate) fn attach(
        &self,
        socket: TcpStream,
    ) -> impl AsyncRead + AsyncWrite + Send + Sync + Unpin + use<> {
        let (input, mut out) = socket.into_split();
        let (reported, waiting) = tokio::io::duplex(WAITING_BYTES_MAX);
        let task = tokio::spawn(async move {
            let mut waiting = BufReader::with_capacity(WRITE_BYTES_MAX, waiting);
            // The reading side reports a broken connection.
            let _ = tokio::io::copy_buf(&mut waiting, &mut out).await;
            let _ = out.shutdown().await;
        });
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(task);
        tokio::io::join(input, reported)
    }

    /// Waits until the task has written the output of a connection that was dropped. Returns at once if no socket was
    /// attached since the last call.
    pub(crate) async fn finish(&self) {
        let task = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(task) = task {
            // A failed task has no more output.
            let _ = task.await;
        }
    }
}
