//! Which pixels the texels around a pixel contribute to: found out in a thread, once for all of them.

use std::io;

use crate::inspect::Contributions;
use crate::viewer::inspector::samples::Target;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;

/// The state of finding out; pixels that cannot be replayed have `None`.
pub(in crate::viewer) type Contributing = Latest<Target, Option<Contributions>>;

/// Starts the thread.
pub(in crate::viewer) fn start(mailbox: Mailbox<(Target, Option<Contributions>)>) -> io::Result<Contributing> {
    Latest::answering("feed", mailbox, |target: &Target| {
        let picture = &target.picture;
        Contributions::around(&picture.subject(), picture.size, target.pixel)
    })
}
