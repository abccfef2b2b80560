//! The preview of a sheet: drawn by its command line in a thread, as large as there is room.

use std::io;
use std::path::Path;
use std::sync::Arc;

use crate::figure::shrunk;
use crate::raster::Framebuffer;
use crate::scene::{DialectChoice, Scene};
use crate::viewer::export::sheet::drawing::SheetRequest;
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::guarded;

/// Reads the words of a `sheet` command, without the program's name, by the grammar of the command line.
pub type ReadSheet = fn(&[String]) -> Result<SheetRequest, String>;

/// A scene that is read already.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct KnownScene {
    pub(in crate::viewer) scene: Arc<Scene>,
    pub(in crate::viewer) dialect: DialectChoice,
    /// Which document it is, and which reading of it.
    pub(in crate::viewer) document: u64,
}

/// The state of previews.
pub(in crate::viewer) type Previews = Latest<SheetQuestion, Result<SheetPreview, String>>;

/// The sheet that a preview is wanted of.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct SheetQuestion {
    pub(in crate::viewer) words: Vec<String>,
    pub(in crate::viewer) read: ReadSheet,
    pub(in crate::viewer) known: KnownScene,
    pub(in crate::viewer) room: [u32; 2],
}

/// A sheet as it will be.
#[derive(Clone, Debug)]
pub struct SheetPreview {
    /// The sheet, made smaller where there is not room for all of it. Opaque.
    pub picture: Framebuffer,
    /// Width and height of the sheet itself, in pixels.
    pub size: [u32; 2],
    /// How many panels it has.
    pub panels: usize,
}

impl PartialEq for SheetQuestion {
    fn eq(&self, other: &Self) -> bool {
        let known = |question: &Self| (question.known.document, question.known.dialect);
        self.words == other.words && self.room == other.room && known(self) == known(other)
    }
}

/// Starts the thread that draws previews.
pub(in crate::viewer) fn start(
    mailbox: Mailbox<(SheetQuestion, Result<SheetPreview, String>)>,
) -> io::Result<Previews> {
    Latest::start("sheet", move |question: SheetQuestion| {
        let drawn = guarded(|| question.preview());
        let drawn = drawn.unwrap_or_else(|| Err("drawing this sheet failed inside the program".to_owned()));
        mailbox.post((question, drawn));
    })
}

impl SheetQuestion {
    /// What the words ask for.
    pub(in crate::viewer) fn request(&self) -> Result<SheetRequest, String> {
        (self.read)(&self.words)
    }

    fn preview(&self) -> Result<SheetPreview, String> {
        let request = self.request()?;
        let first = request.first().cloned().ok_or("a sheet without panels")?;
        let sheet = request.draw(
            &mut |dialect| self.known.read_in(dialect, &first),
            Path::new("sheet.png"),
        )?;
        Ok(SheetPreview {
            size: [sheet.picture.width(), sheet.picture.height()],
            panels: sheet.panels.len(),
            picture: shrunk(&sheet.picture, self.room),
        })
    }
}

impl KnownScene {
    /// The scene as `dialect` reads it.
    pub(in crate::viewer) fn read_in(&self, dialect: DialectChoice, spec: &PictureSpec) -> Result<Arc<Scene>, String> {
        if dialect == self.dialect {
            return Ok(Arc::clone(&self.scene));
        }
        let scene = spec.scene.read(dialect).map_err(|error| error.to_string())?;
        Ok(Arc::new(scene))
    }
}
