//! Why a pixel has its colour: found out in a thread.

use std::io;

use crate::inspect::{Explanation, Question};
use crate::render::Subject;
use crate::viewer::frames::frame::Picture;
use crate::viewer::inspector::samples::Target;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;

/// The state of explaining; a pixel that cannot be explained has `None`.
pub(in crate::viewer) type Explaining = Latest<Asked, Option<Explained>>;

/// Why a pixel has its colour, and why it has B's.
#[derive(Debug)]
pub(in crate::viewer) struct Explained {
    pub(in crate::viewer) own: Explanation,
    pub(in crate::viewer) other: Option<Explanation>,
}

/// What is to be explained.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::viewer) struct Asked {
    pub(in crate::viewer) target: Target,
    /// B, where it is drawn by us too.
    pub(in crate::viewer) other: Option<Picture>,
    /// The scene's name in the list, for quotations.
    pub(in crate::viewer) file: String,
}

/// Starts the thread that explains.
pub(in crate::viewer) fn start(mailbox: Mailbox<(Asked, Option<Explained>)>) -> io::Result<Explaining> {
    Latest::answering("explain", mailbox, Asked::explain)
}

impl Asked {
    pub(in crate::viewer) fn explain(&self) -> Option<Explained> {
        Some(Explained {
            own: self.explain_in(&self.target.picture)?,
            other: self.other.as_ref().and_then(|other| self.explain_in(other)),
        })
    }

    fn explain_in(&self, picture: &Picture) -> Option<Explanation> {
        Explanation::advised(&Question {
            subject: Subject {
                scene: &picture.scene,
                view: &picture.view,
                settings: &picture.settings,
            },
            file: &self.file,
            size: picture.size,
            pixel: self.target.pixel,
        })
    }
}
