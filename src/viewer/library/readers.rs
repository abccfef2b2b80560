//! Threads that read documents and draw thumbnails.

use std::io;
use std::sync::Arc;

use crate::geometry::{View, ViewTransform};
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{RenderSettings, draw};
use crate::scene::{DialectChoice, Progress, Scene};
use crate::texture::{LevelSampling, PixelSampling};
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool, guarded};
use crate::viewer::library::stamps::Stamps;
use crate::viewer::library::{ReadFailure, SceneEntry, SceneSource, SceneState};

/// Threads that read: a second one, so that a slow scene does not hold up the next.
const READERS: usize = 2;

/// Longer side of a thumbnail, in pixels.
const THUMBNAIL_SIDE: f64 = 160.0;

/// The threads that read.
#[derive(Debug)]
pub(in crate::viewer) struct Readers {
    pub(in crate::viewer) scenes: WorkerPool<Order>,
    pub(in crate::viewer) thumbnails: WorkerPool<Order>,
    pub(in crate::viewer) pending_thumbnails: usize,
}

/// Whose dialect a scene is read in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Side {
    A,
    B,
}

impl Side {
    /// Who waits for a scene to be read in a dialect. A and B may have changed places since that began.
    pub(in crate::viewer) fn reading(entry: &SceneEntry, dialect: DialectChoice) -> Option<Self> {
        let waits =
            |state: &SceneState| matches!(state, SceneState::Reading { dialect: wanted, .. } if *wanted == dialect);
        if waits(&entry.state) {
            return Some(Self::A);
        }
        waits(&entry.other_state).then_some(Self::B)
    }

    pub(in crate::viewer) fn state(self, entry: &mut SceneEntry) -> &mut SceneState {
        match self {
            Self::A => &mut entry.state,
            Self::B => &mut entry.other_state,
        }
    }
}

/// Which scene, and for which list.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct Order {
    pub(in crate::viewer) generation: u64,
    pub(in crate::viewer) index: usize,
    pub(in crate::viewer) document: u64,
    pub(in crate::viewer) source: SceneSource,
    pub(in crate::viewer) dialect: DialectChoice,
    pub(in crate::viewer) progress: Progress,
    /// Set where it was read already.
    pub(in crate::viewer) scene: Option<Arc<Scene>>,
}

/// A scene that was read, or not.
#[derive(Debug)]
pub(in crate::viewer) struct ReadScene {
    pub(in crate::viewer) generation: u64,
    pub(in crate::viewer) index: usize,
    pub(in crate::viewer) document: u64,
    pub(in crate::viewer) dialect: DialectChoice,
    /// The files that it was read from.
    pub(in crate::viewer) stamps: Stamps,
    pub(in crate::viewer) result: Result<Arc<Scene>, ReadFailure>,
}

/// A thumbnail that was drawn, or not.
#[derive(Debug)]
pub(in crate::viewer) struct Thumbnail {
    pub(in crate::viewer) generation: u64,
    pub(in crate::viewer) index: usize,
    pub(in crate::viewer) picture: Option<Arc<Framebuffer>>,
}

impl Readers {
    pub(in crate::viewer) fn start(scenes: Mailbox<ReadScene>, thumbnails: Mailbox<Thumbnail>) -> io::Result<Self> {
        let read = move |order: Order| {
            let Order {
                generation,
                index,
                document,
                dialect,
                ..
            } = order;
            // Taken first: what is saved while it is read is read again.
            let mut stamps = Stamps::of_document(order.source.document());
            let result = order.read();
            if let Ok(scene) = &result {
                order.source.textures(scene).for_each(|texture| stamps.note(texture));
            }
            scenes.post(ReadScene {
                generation,
                index,
                document,
                dialect,
                stamps,
                result,
            });
        };
        let draw = move |order: Order| {
            let (generation, index) = (order.generation, order.index);
            let picture = order.thumbnail();
            thumbnails.post(Thumbnail {
                generation,
                index,
                picture,
            });
        };
        Ok(Self {
            scenes: WorkerPool::start("read", READERS, AtEnd::Detach, read)?,
            thumbnails: WorkerPool::start("thumbnails", 1, AtEnd::Detach, draw)?,
            pending_thumbnails: 0,
        })
    }

    /// Forgets the thumbnails that wait: they belong to an old list.
    pub(in crate::viewer) fn drop_thumbnails(&mut self) {
        let dropped = self.thumbnails.take_back();
        self.pending_thumbnails = self.pending_thumbnails.saturating_sub(dropped.len());
    }

    pub(in crate::viewer) fn has_thumbnails_pending(&self) -> bool {
        self.pending_thumbnails > 0
    }
}

impl Order {
    fn read(&self) -> Result<Arc<Scene>, ReadFailure> {
        let read = guarded(|| self.source.read_watched(self.dialect, &self.progress));
        match read {
            Some(Ok(scene)) => Ok(Arc::new(scene)),
            Some(Err(error)) => Err(ReadFailure {
                message: error.to_string(),
                line: error.line,
            }),
            None => Err(ReadFailure {
                message: format!(
                    "{}: reading this document failed inside the program; please report it with the file",
                    self.source.address()
                ),
                line: None,
            }),
        }
    }

    /// The scene in small. It uses one thread, to leave the others to the frames of the window.
    fn thumbnail(self) -> Option<Arc<Framebuffer>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
        let picture = pool.install(|| {
            let scene = match &self.scene {
                Some(scene) => Arc::clone(scene),
                None => self.read().ok()?,
            };
            guarded(|| draw_thumbnail(&scene))
        })?;
        Some(Arc::new(picture))
    }
}

/// The whole canvas, as large as a thumbnail may be.
fn draw_thumbnail(scene: &Scene) -> Framebuffer {
    let size = scene.canvas * (THUMBNAIL_SIDE / scene.canvas.max_element());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and the longer side"
    )]
    let side = |length: f64| length.round().clamp(1.0, THUMBNAIL_SIDE) as u32;
    let mut frame = Framebuffer::new(side(size.x), side(size.y));
    let view: ViewTransform = View::Canvas.transform(scene.canvas, [frame.width(), frame.height()]);
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap_or_default(),
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        outline: false,
        ..RenderSettings::default()
    };
    draw(scene, &view, &settings, &mut frame);
    frame
}
