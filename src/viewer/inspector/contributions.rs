//! Which pixels the texels around a pixel contribute to: found out in a thread, once for all of them.

use std::io;

use crate::inspect::Feeds;
use crate::viewer::inspector::samples::Target;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::guarded;

/// The state of finding out; pixels that cannot be replayed have `None`.
pub(in crate::viewer) type Feeding = Latest<Target, Option<Feeds>>;

/// Starts the thread.
pub(in crate::viewer) fn start(mailbox: Mailbox<(Target, Option<Feeds>)>) -> io::Result<Feeding> {
    Latest::start("feed", move |target: Target| {
        let picture = &target.picture;
        let feeds = guarded(|| Feeds::around(&picture.subject(), picture.size, target.pixel));
        mailbox.post((target, feeds.unwrap_or_default()));
    })
}
