//! Asks the person at the terminal whether an interrupted show goes on.

use std::io::BufRead;

use tokio::sync::oneshot;

use crate::say;

/// The question whether an interrupted show goes on, and its answer: a line on stdin.
#[derive(Debug, Default)]
pub struct GoOn(Option<oneshot::Receiver<bool>>);

impl GoOn {
    /// Asks, unless that was asked already.
    pub fn ask(&mut self) {
        if self.0.is_some() {
            return;
        }
        say::note("look at the floor, then press Enter to go on, or Ctrl-C to end the show");
        let (sender, receiver) = oneshot::channel();
        // A thread of its own: a program that ends does not wait for it, as it would for a task that reads.
        std::thread::spawn(move || {
            let read = std::io::stdin().lock().read_line(&mut String::new());
            // The show may be over by now.
            let _ = sender.send(read.is_ok_and(|bytes| bytes > 0));
        });
        self.0 = Some(receiver);
    }

    /// Waits for the answer; false: there is no one to press. Never ends where nothing was asked.
    pub async fn answer(&mut self) -> bool {
        let Some(receiver) = &mut self.0 else { return std::future::pending().await };
        let answer = receiver.await.unwrap_or(false);
        self.0 = None;
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn an_answer_ends_the_question() {
        let (sender, receiver) = oneshot::channel();
        let mut go_on = GoOn(Some(receiver));
        sender.send(true).unwrap();
        assert!(go_on.answer().await);
        assert!(go_on.0.is_none());
    }
}
