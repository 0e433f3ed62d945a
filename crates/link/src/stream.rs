//! A TCP connection that goes on hearing while it cannot speak.
//!
//! The MQTT client hears nothing until all it said is out, and a broker may do the same: where thousands of robots answer
//! while as many commands go out, each would wait for the other to listen. Here what is said is taken at once, and
//! written beside.

use std::sync::{Arc, Mutex, PoisonError};

use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt, BufReader};
use tokio::net::TcpStream;
use tokio::task::JoinHandle;

/// So many bytes may wait to be written: more than a fleet of ten thousand is told at once.
const WAITING: usize = 16 << 20;
/// Written together at most, bytes.
const TOGETHER: usize = 64 << 10;

/// The task that writes for the present connection. It ends once all that was said is out, or cannot go out any more.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mouth(Arc<Mutex<Option<JoinHandle<()>>>>);

impl Mouth {
    /// A connection that is written by this mouth from now on.
    pub(crate) fn speaks_on(
        &self,
        socket: TcpStream,
    ) -> impl AsyncRead + AsyncWrite + Send + Sync + Unpin + use<> {
        let (ear, mut out) = socket.into_split();
        let (said, waiting) = tokio::io::duplex(WAITING);
        let task = tokio::spawn(async move {
            let mut waiting = BufReader::with_capacity(TOGETHER, waiting);
            // A connection that broke is noticed by whoever hears on it.
            let _ = tokio::io::copy_buf(&mut waiting, &mut out).await;
            let _ = out.shutdown().await;
        });
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(task);
        tokio::io::join(ear, said)
    }

    /// Waits until all is out that was said on a connection that is dropped.
    pub(crate) async fn finish(&self) {
        let task = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(task) = task {
            // One that failed has nothing more to say.
            let _ = task.await;
        }
    }
}
