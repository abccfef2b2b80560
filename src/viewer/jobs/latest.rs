//! Answers about what is on the screen, found out in a thread: only the newest question counts.

use std::io;

use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool, guarded};

/// The newest question, and the newest answer.
#[derive(Debug)]
pub(in crate::viewer) struct Latest<Q, A> {
    workers: WorkerPool<Q>,
    wanted: Option<Q>,
    found: Option<(Q, A)>,
    is_running: bool,
    /// Grows with every change of what [`Latest::answer`] gives.
    number: u64,
}

impl<Q: Clone + PartialEq + Send + 'static, A> Latest<Q, A> {
    /// Starts a thread called `name`; `work` finds out and posts what then comes to [`Latest::finished`].
    ///
    /// # Errors
    /// When the system gives no thread.
    pub(in crate::viewer) fn start(name: &str, work: impl Fn(Q) + Clone + Send + 'static) -> io::Result<Self> {
        Ok(Self {
            workers: WorkerPool::start(name, 1, AtEnd::Detach, work)?,
            wanted: None,
            found: None,
            is_running: false,
            number: 0,
        })
    }

    /// As [`Latest::start`]: `find` finds out, and `mailbox` leads to [`Latest::finished`]. A defect of the program counts as the
    /// answer of one who knows nothing.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub(in crate::viewer) fn answering(
        name: &str,
        mailbox: Mailbox<(Q, A)>,
        find: impl Fn(&Q) -> A + Clone + Send + 'static,
    ) -> io::Result<Self>
    where
        A: Default + Send + 'static,
    {
        Self::start(name, move |question| {
            let answer = guarded(|| find(&question)).unwrap_or_default();
            mailbox.post((question, answer));
        })
    }

    /// The answer to the question that was asked last, once it is there.
    pub(in crate::viewer) fn answer(&self) -> Option<&A> {
        let (question, answer) = self.found.as_ref()?;
        (self.wanted.as_ref() == Some(question)).then_some(answer)
    }

    /// The newest answer, which may be to an earlier question.
    pub(in crate::viewer) fn newest(&self) -> Option<&A> {
        self.found.as_ref().map(|(_, answer)| answer)
    }

    /// Another number, another answer.
    pub(in crate::viewer) fn number(&self) -> u64 {
        self.number
    }

    /// Whether what was asked is answered.
    pub(in crate::viewer) fn is_current(&self) -> bool {
        self.wanted.is_none() || self.answer().is_some()
    }

    /// Asks, or asks nothing; `at_once` may answer what takes no time.
    pub(in crate::viewer) fn want(&mut self, question: Option<Q>, at_once: impl FnOnce(&Q) -> Option<A>) {
        if self.wanted == question {
            return;
        }
        self.wanted = question;
        self.number += 1;
        if self.is_running || self.is_current() {
            return;
        }
        if let Some(question) = &self.wanted
            && let Some(answer) = at_once(question)
        {
            self.found = Some((question.clone(), answer));
            return;
        }
        self.next();
    }

    /// Takes in what the thread found out.
    pub(in crate::viewer) fn finished(&mut self, question: Q, answer: A) {
        self.is_running = false;
        self.found = Some((question, answer));
        self.number += 1;
        self.next();
    }

    fn next(&mut self) {
        if !self.is_running
            && !self.is_current()
            && let Some(question) = self.wanted.clone()
        {
            self.is_running = true;
            self.workers.push(question);
        }
    }
}
