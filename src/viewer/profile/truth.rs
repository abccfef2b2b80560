//! What the truth has along a line: the tiles that the line crosses, drawn with 256 samples in a thread.

use std::io;

use crate::color::ResolveSpace;
use crate::compare::{Line, Profile};
use crate::raster::Framebuffer;
use crate::render::{CancelToken, Subject, draw_regions};
use crate::viewer::frames::frame::Picture;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;

/// The state of drawing; what cannot be drawn is `None`.
pub(in crate::viewer) type TruthAlong = Latest<LineOfPicture, Option<Profile>>;

/// A line across a picture.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::viewer) struct LineOfPicture {
    pub(in crate::viewer) picture: Picture,
    pub(in crate::viewer) line: Line,
    /// In which values the truth is averaged, where not in the picture's.
    pub(in crate::viewer) space: Option<ResolveSpace>,
}

/// Starts the thread.
pub(in crate::viewer) fn start(mailbox: Mailbox<(LineOfPicture, Option<Profile>)>) -> io::Result<TruthAlong> {
    Latest::answering("profile", mailbox, LineOfPicture::truth)
}

impl LineOfPicture {
    fn truth(&self) -> Option<Profile> {
        let Picture {
            scene,
            view,
            settings,
            size,
            ..
        } = &self.picture;
        let subject = Subject {
            scene,
            view,
            settings: &settings.truth_in(self.space),
        };
        let mut frame = Framebuffer::new(size[0], size[1]);
        draw_regions(&subject, &mut frame, &self.line.regions(*size), &CancelToken::default())?;
        Some(Profile::of(&frame, self.line))
    }
}
