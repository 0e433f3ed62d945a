//! A TCP connection that goes on hearing while it cannot speak.
//!
//! The MQTT client hears nothing until all it said is out, and a broker may do the same: where thousands of robots answer
//! while as many commands go out, each would wait for the other to listen. Here what is said is taken at once, and
//! written beside.

use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt, BufReader};
use tokio::net::TcpStream;

/// So many bytes may wait to be written: more than a fleet of ten thousand is told at once.
const WAITING: usize = 16 << 20;
/// Written together at most, bytes.
const TOGETHER: usize = 64 << 10;

pub(crate) fn patient(socket: TcpStream) -> impl AsyncRead + AsyncWrite + Send + Sync + Unpin {
    let (ear, mut mouth) = socket.into_split();
    let (said, waiting) = tokio::io::duplex(WAITING);
    tokio::spawn(async move {
        let mut waiting = BufReader::with_capacity(TOGETHER, waiting);
        // A connection that broke is noticed by whoever hears on it.
        let _ = tokio::io::copy_buf(&mut waiting, &mut mouth).await;
        let _ = mouth.shutdown().await;
    });
    tokio::io::join(ear, said)
}
