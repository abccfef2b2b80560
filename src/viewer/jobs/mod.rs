//! Threads beside the user interface: pools of workers, the newest question, mailboxes for results.

pub(in crate::viewer) mod latest;
pub(in crate::viewer) mod mailbox;
pub(in crate::viewer) mod pool;
