//! Asks the person at the terminal to press Enter, for GO or to resume an interrupted show.

use std::io::BufRead;

use tokio::sync::oneshot;

use crate::say;

/// What Enter is pressed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnterFor {
    /// A frame waits for GO.
    Go,
    /// An interrupted show is to go on.
    GoOn,
}

/// The question at the terminal that waits for Enter; `None`: there is none. Its receiver gets `true` when a line was read,
/// `false` at the end of the input.
#[derive(Debug, Default)]
pub struct EnterKey(Option<(EnterFor, oneshot::Receiver<bool>)>);

impl EnterKey {
    /// Prints `question`, unless it is waiting for an answer already. If another question is waiting, `question` replaces
    /// it, and the next Enter answers `question`.
    pub fn ask(&mut self, question: EnterFor) {
        match &mut self.0 {
            Some((asked, _)) if *asked == question => return,
            Some((asked, _)) => *asked = question,
            None => self.0 = Some((question, read_line())),
        }
        say::note(match question {
            EnterFor::Go => "press Enter for GO",
            EnterFor::GoOn => "look at the floor, then press Enter to go on, or Ctrl-C to end the show",
        });
    }

    /// Waits for the answer to the waiting question. Returns that question, and whether Enter was pressed: `false` at the
    /// end of the input. Waits for ever if no question is waiting.
    pub async fn answer(&mut self) -> (EnterFor, bool) {
        let Some((question, receiver)) = &mut self.0 else { return std::future::pending().await };
        let answer = (*question, receiver.await.unwrap_or(false));
        self.0 = None;
        answer
    }
}

fn read_line() -> oneshot::Receiver<bool> {
    let (sender, receiver) = oneshot::channel();
    // A separate thread, because a program that ends waits for a blocking task but not for a thread.
    std::thread::spawn(move || {
        let read = std::io::stdin().lock().read_line(&mut String::new());
        // The receiver is gone if the show is over.
        let _ = sender.send(read.is_ok_and(|bytes| bytes > 0));
    });
    receiver
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn an_answer_ends_the_question_that_was_asked_last() {
        let (sender, receiver) = oneshot::channel();
        let mut enter = EnterKey(Some((EnterFor::Go, receiver)));
        enter.ask(EnterFor::GoOn);
        sender.send(true).unwrap();
        assert_eq!(enter.answer().await, (EnterFor::GoOn, true));
        assert!(enter.0.is_none());
    }
}
