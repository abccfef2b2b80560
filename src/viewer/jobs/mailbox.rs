//! How what a thread finished comes back: results of every kind arrive in one channel, and the waker tells whoever waits for
//! events that something is there.
//!
//! A service posts its own results and knows nothing of the channel's messages: its mailbox is given their constructor.

use std::fmt;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// Called from other threads when there is something to take in.
pub type Waker = Arc<dyn Fn() + Send + Sync>;

/// Where finished work goes.
pub(in crate::viewer) struct Mailbox<T> {
    /// False where nobody is there any more.
    deliver: Arc<dyn Fn(T) -> bool + Send + Sync>,
    waker: Waker,
}

impl<T: Send + 'static> Mailbox<T> {
    pub(in crate::viewer) fn new(sender: Sender<T>, waker: Waker) -> Self {
        Self {
            deliver: Arc::new(move |result| sender.send(result).is_ok()),
            waker,
        }
    }

    /// The same for results that become messages by `wrap`.
    pub(in crate::viewer) fn of<R: 'static>(&self, wrap: impl Fn(R) -> T + Send + Sync + 'static) -> Mailbox<R> {
        let deliver = Arc::clone(&self.deliver);
        Mailbox {
            deliver: Arc::new(move |result| deliver(wrap(result))),
            waker: Arc::clone(&self.waker),
        }
    }
}

impl<T> Mailbox<T> {
    /// Hands over `result` and wakes the receiver. Nobody may be there any more: then the result is dropped.
    pub(in crate::viewer) fn post(&self, result: T) {
        if (self.deliver)(result) {
            (self.waker)();
        }
    }
}

impl<T> fmt::Debug for Mailbox<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mailbox").finish_non_exhaustive()
    }
}

impl<T> Clone for Mailbox<T> {
    fn clone(&self) -> Self {
        Self {
            deliver: Arc::clone(&self.deliver),
            waker: Arc::clone(&self.waker),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn mailboxes_of_services_lead_to_one_channel() {
        let (sender, receiver) = channel();
        let mailbox = Mailbox::new(sender, Arc::new(|| {}));
        mailbox.of(|number: u32| number.to_string()).post(1);
        mailbox.of(|text: &str| text.to_owned()).post("two");
        drop(mailbox);
        assert_eq!(receiver.iter().collect::<Vec<_>>(), ["1", "two"], "as messages");
    }

    #[test]
    fn mailbox_without_receiver() {
        let (sender, receiver) = channel();
        drop(receiver);
        Mailbox::new(sender, Arc::new(|| panic!("nobody is there to be woken"))).post(1);
    }
}
